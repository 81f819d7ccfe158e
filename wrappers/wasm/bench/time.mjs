// Compares the time per frame of the WebAssembly modules with that of the C++ library without AVX2.
// The modules and the library are measured alternately.
//
//   node wrappers/wasm/bench/time.mjs [ROUNDS [GOLDEN]]
//
// Needs the built package, and the targets dotpose_golden_files and dotpose_wasm_time of the
// release preset.
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { Locator } from "../dist/index.js";
import { imagesOf, kSets } from "../test/golden.mjs";

const kBin = new URL("../../../build/release/bin/", import.meta.url).pathname;
const kDist = new URL("../dist/", import.meta.url).pathname;
const kNative = join(kBin, "dotpose_wasm_time");
const kVariants = ["simd", "scalar"].filter((name) => existsSync(join(kDist, `dotpose-${name}.wasm`)));
const rounds = Number(process.argv[2] ?? 5);

/**
 * Returns the time of each frame, in µs. Times without and with a prediction alternate, as in the
 * output of the native program.
 */
function measure(locator, images) {
    const times_us = [];
    const timed = (call) => {
        const start = performance.now();
        const fix = call();
        times_us.push(1000 * (performance.now() - start));
        return fix;
    };
    for (let i = 0; i < images.length; i += 2) {
        const prediction = timed(() => locator.locate(images[i]));
        if (prediction.ok) timed(() => locator.locate(images[i + 1], { prediction }));
        else times_us.push(0);
    }
    return times_us;
}

function measureNative(path) {
    const lines = execFileSync(kNative, [path], { encoding: "utf8" });
    return lines.trim().split(/\s+/).map(Number);
}

/** Returns the minimum of each time over the rounds so far, to exclude the influence of other programs. */
function keepLeast(least, times_us) {
    return times_us.map((us, i) => Math.min(us, least?.[i] ?? Infinity));
}

/**
 * Returns the mean time per frame, in µs: without a prediction if `way` is 0, and with a prediction
 * if `way` is 1.
 */
function mean(times_us, way) {
    const chosen = times_us.filter((_, i) => i % 2 === way);
    return chosen.reduce((sum, us) => sum + us) / chosen.length;
}

function printTimes(set, [native, ...others]) {
    ["alone", "tracked"].forEach((name, way) => {
        const native_us = mean(native, way);
        const cells = others.map((times) => mean(times, way)).map((us) => `${us.toFixed(0)} (${(us / native_us).toFixed(2)})`);
        const columns = [native_us.toFixed(0).padStart(8), ...cells.map((cell) => cell.padStart(14))];
        console.log(`${set}, ${name}`.padEnd(20), ...columns);
    });
}

function printSizes() {
    console.log("\nsize in bytes".padEnd(22), ...["file", "gzip", "brotli"].map((name) => name.padStart(8)));
    for (const name of [...kVariants, "tools"]) {
        const bytes = readFileSync(join(kDist, `dotpose-${name}.wasm`));
        const sizes = [bytes, gzipSync(bytes, { level: 9 }), brotliCompressSync(bytes)];
        console.log(`dotpose-${name}.wasm`.padEnd(21), ...sizes.map(({ length }) => `${length}`.padStart(8)));
    }
}

const folder = mkdtempSync(join(tmpdir(), "dotpose-"));
try {
    const golden = process.argv[3] ?? folder;
    if (golden === folder) execFileSync(join(kBin, "dotpose_golden_files"), [folder]);
    const wasm = (variant) => readFileSync(join(kDist, `dotpose-${variant}.wasm`));
    const create = (variant) => Locator.create({ code: "anoto", wasm: wasm(variant) });
    const locators = await Promise.all(kVariants.map(create));
    console.log(`microseconds per frame, the least of ${rounds} rounds; in brackets: as a multiple of C++\n`);
    console.log("frames".padEnd(20), "C++".padStart(8), ...kVariants.map((name) => name.padStart(14)));
    for (const set of kSets) {
        const path = join(golden, `${set}.frames`);
        const images = [...imagesOf(readFileSync(path))];
        for (const locator of locators) measure(locator, images); // warms up the engine's optimizer
        const least = [];
        for (let round = 0; round < rounds; ++round) {
            least[0] = keepLeast(least[0], measureNative(path));
            locators.forEach((locator, i) => (least[1 + i] = keepLeast(least[1 + i], measure(locator, images))));
        }
        printTimes(set, least);
    }
} finally {
    rmSync(folder, { recursive: true });
}
printSizes();
