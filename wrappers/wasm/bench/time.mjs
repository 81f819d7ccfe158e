// Compares the time of the modules with that of the C++ library without AVX2, in turns.
//
//   node wrappers/wasm/bench/time.mjs [ROUNDS]
//
// needs the built package, and of the release preset the targets dotpose_golden_files and dotpose_wasm_time.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { Locator } from "../dist/index.js";
import { imagesOf, kSets } from "../test/golden.mjs";

const kBin = new URL("../../../build/release/bin/", import.meta.url).pathname;
const kDist = new URL("../dist/", import.meta.url).pathname;
const kVariants = ["simd", "scalar"];
const rounds = Number(process.argv[2] ?? 5);

/** Returns microseconds per frame, alone and tracked, as the native program measures them. */
function measure(locator, images) {
    const sums_us = [0, 0];
    const timed = (i, call) => {
        const start = performance.now();
        const fix = call();
        sums_us[i] += 1000 * (performance.now() - start);
        return fix;
    };
    for (let i = 0; i < images.length; i += 2) {
        const prediction = timed(0, () => locator.locate(images[i]));
        if (prediction.ok) timed(1, () => locator.locate(images[i + 1], { prediction }));
    }
    return sums_us.map((sum) => sum / (images.length / 2));
}

/** Adds the times of a round to the least of each: by set and way, C++ first, then the variants. */
function keepLeast(least, column, times) {
    times.flat().forEach((us, row) => {
        least[row] ??= [];
        least[row][column] = Math.min(least[row][column] ?? Infinity, us);
    });
}

function printTimes(least) {
    console.log(`microseconds per frame, least of ${rounds} rounds; in brackets: as a multiple of C++\n`);
    console.log("frames".padEnd(20), "C++".padStart(8), ...kVariants.map((name) => name.padStart(14)));
    least.forEach(([native, ...others], row) => {
        const name = `${kSets[row >> 1]}, ${["alone", "tracked"][row & 1]}`;
        const cells = others.map((us) => `${us.toFixed(0)} (${(us / native).toFixed(2)})`.padStart(14));
        console.log(name.padEnd(20), native.toFixed(0).padStart(8), ...cells);
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
    execFileSync(join(kBin, "dotpose_golden_files"), [folder]);
    const paths = kSets.map((set) => join(folder, `${set}.frames`));
    const sets = paths.map((path) => [...imagesOf(readFileSync(path))]);
    const locators = [];
    for (const variant of kVariants) {
        const wasm = readFileSync(join(kDist, `dotpose-${variant}.wasm`));
        locators.push(await Locator.create({ code: "anoto", wasm }));
        sets.forEach((images) => measure(locators.at(-1), images)); // until the engine has optimized
    }
    const least = [];
    for (let round = 0; round < rounds; ++round) {
        const native = execFileSync(join(kBin, "dotpose_wasm_time"), paths, { encoding: "utf8" });
        keepLeast(least, 0, native.trim().split(/\s+/).map(Number));
        locators.forEach((locator, i) => keepLeast(least, 1 + i, sets.map((images) => measure(locator, images))));
    }
    printTimes(least);
} finally {
    rmSync(folder, { recursive: true });
}
printSizes();
