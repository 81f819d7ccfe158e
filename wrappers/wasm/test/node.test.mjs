// Tests the packed and installed package in Node. The environment variable DOTPOSE_GOLDEN is the
// folder that contains the golden files.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { before, describe, test } from "node:test";
import { inflateSync } from "node:zlib";
import { compareSet, kSets } from "./golden.mjs";
import { dotpose, kTool, resolve, Tools, url } from "./installed.mjs";

const { Locator, Tracker } = dotpose;

/** A frame with a known pose. */
const kScene = { sheet: { origin: { x: 1000, y: 2000 } }, pose: { x_mm: 560, y_mm: 1070, theta_rad: 0.5 } };

describe("golden frames: the same bits as the C++ library", () => {
    const golden = (name) => readFileSync(join(process.env.DOTPOSE_GOLDEN, name));
    for (const variant of ["simd", "scalar"]) {
        for (const set of kSets) {
            test(`${variant}, ${set}`, async () => {
                const wasm = url(`dotpose/dotpose-${variant}.wasm`);
                const [frames, csv] = [golden(`${set}.frames`), golden(`${set}.csv`)];
                const counts = await compareSet(dotpose, frames, csv.toString(), wasm);
                assert.deepEqual(counts.different, []);
                assert.ok(counts.lines >= 3 * 40 && counts.ok > 0.9 * counts.lines, JSON.stringify(counts));
                assert.ok(counts.tracked > 0.2 * counts.lines, JSON.stringify(counts));
            });
        }
    }
    test("the modules import nothing", () => {
        for (const name of ["simd", "scalar", "space", "tools"]) {
            const module = new WebAssembly.Module(readFileSync(resolve(`dotpose/dotpose-${name}.wasm`)));
            assert.deepEqual(WebAssembly.Module.imports(module), [], name);
        }
    });
});

describe("Locator", () => {
    let tools;
    before(async () => (tools = await Tools.create()));

    test("finds a simulated camera, whatever the code is", async () => {
        const fix = (await Locator.create()).locate(tools.render(kScene));
        assert.equal(fix.status, "ok");
        assert.equal(fix.ok, true);
        assert.ok(Math.abs(fix.x_mm - 560) < 0.003 && Math.abs(fix.y_mm - 1070) < 0.003, `${fix.x_mm}, ${fix.y_mm}`);
        assert.ok(Math.abs(fix.theta_rad - 0.5) < 0.002);
        assert.ok(fix.p_wrong > 0 && fix.p_wrong <= 2 ** -30);
        assert.deepEqual(fix.section, { u: 0, v: 0 });
        assert.deepEqual(fix.cell, { x: Math.floor(fix.x_mm / 0.508), y: Math.floor(fix.y_mm / 0.508) });
        assert.equal(fix.code, "anoto");
        assert.equal(fix.covariance.length, 9);
        assert.ok(fix.covariance[0] > 0 && fix.covariance[0] < 1e-4);
        assert.equal(fix.dots, null);
    });

    test("reads other codes, alone and by itself", async () => {
        const scene = { ...kScene, sheet: { ...kScene.sheet, code: "microdots" } };
        const image = tools.render(scene);
        assert.equal((await Locator.create({ code: "microdots" })).locate(image).ok, true);
        const fix = (await Locator.create()).locate(image);
        assert.equal(fix.ok ? fix.code : fix.status, fix.ok ? "microdots" : "ambiguous_code");
    });

    test("a known sheet needs only a small view", async () => {
        const camera = { width_px: 66, height_px: 66 };
        const image = tools.render({ ...kScene, camera });
        assert.equal((await Locator.create()).locate(image).ok, false);
        const sheets = [{ first: { x: 1000, y: 2000 }, columns: 393, rows: 564 }];
        const fix = (await Locator.create({ sheets, only_sheets: true })).locate(image);
        assert.equal(fix.status, "ok");
        assert.equal(fix.prior, "only_sheets");
        assert.ok(Math.abs(fix.x_mm - 560) < 0.01 && Math.abs(fix.y_mm - 1070) < 0.01, `${fix.x_mm}, ${fix.y_mm}`);
        const elsewhere = [{ first: { x: 5000, y: 2000 }, columns: 393, rows: 564 }];
        assert.equal((await Locator.create({ sheets: elsewhere, only_sheets: true })).locate(image).ok, false);
        const create = (sheet) => Locator.create({ sheets: [{ ...sheets[0], ...sheet }] });
        await assert.rejects(create({ columns: 0 }), RangeError);
        await assert.rejects(create({ rows: -1 }), /sheets\[0\] is not a rectangle/);
    });

    test("frames of a moving camera that are not certain alone are read together", async () => {
        const camera = { width_px: 80, height_px: 80 };
        const imperfections = { noise_sigma: 3, blur_sigma_px: 0.5 };
        // The motion is exact, so its standard deviations are larger than necessary.
        const step_mm = 3 * 0.508;
        const motion = { right_mm: step_mm, down_mm: step_mm, sigma_mm: 0.02, sigma_rad: 0.005 };
        const frame = (k) => {
            const pose = { x_mm: 560 + k * step_mm, y_mm: 1070 + k * step_mm };
            return { pose, image: tools.render({ ...kScene, pose, camera, imperfections, seed: k + 1 }) };
        };
        for (const code of ["auto", "anoto"]) {
            const [alone, moved] = [await Locator.create({ code }), await Locator.create({ code })];
            const numbers = new Set();
            for (let k = 0; k < 6; ++k) {
                const { pose, image } = frame(k);
                assert.equal(alone.locate(image).ok, false, `frame ${k} is not certain alone`);
                const fix = moved.locate(image, { motion });
                if (!fix.ok) continue;
                numbers.add(fix.frames);
                const error_mm = Math.hypot(fix.x_mm - pose.x_mm, fix.y_mm - pose.y_mm);
                assert.ok(error_mm < 0.01 && fix.p_wrong <= 1e-9, `${error_mm} mm, ${fix.p_wrong}`);
            }
            assert.ok(Math.max(...numbers) > 1, `${code}: ${[...numbers]} frames`);
            // A frame without a motion ends the series.
            assert.equal(moved.locate(frame(6).image).ok, false);
            assert.equal(moved.locate(frame(7).image, { motion }).ok, false);
        }
    });

    test("a motion that is not usable is refused with the name of the number", async () => {
        const locator = await Locator.create();
        const image = tools.render(kScene);
        const good = { sigma_mm: 0.02, sigma_rad: 0.005 };
        const { ok, frames } = locator.locate(image, { motion: good });
        assert.deepEqual({ ok, frames }, { ok: true, frames: 1 });
        const refused = (motion, message) => assert.throws(() => locator.locate(image, { motion }), message);
        const error = (message) => ({ name: "RangeError", message });
        refused({ sigma_rad: 0.01 }, error("motion.sigma_mm must be from 0 to below 1e6, not undefined"));
        refused({ ...good, sigma_rad: -0.1 }, error("motion.sigma_rad must be from 0 to below 1e6, not -0.1"));
        refused({ ...good, right_mm: NaN }, error("motion.right_mm must be between -1e6 and 1e6, not NaN"));
        refused({ ...good, down_mm: 1e6 }, error("motion.down_mm must be between -1e6 and 1e6, not 1000000"));
        refused({ ...good, turn_rad: "1" }, error("motion.turn_rad must be between -1e6 and 1e6, not 1"));
        const prediction = locator.locate(image);
        assert.throws(() => locator.locate(image, { prediction, motion: good }), /give a prediction or a motion, not both/);
    });

    test("a frame without a pattern is a fix with a reason", async () => {
        const fix = (await Locator.create()).locate({ data: new Uint8Array(188 * 120).fill(200), width: 188, height: 120 });
        assert.equal(fix.ok, false);
        assert.equal(fix.status, "no_contrast");
        assert.match(fix.message, /^[A-Za-z].*[^.]$/);
        assert.ok(Number.isNaN(fix.x_mm));
    });

    test("rows with a stride are the same image", async () => {
        const { data, width, height } = tools.render(kScene);
        const stride = width + 13;
        const wide = new Uint8ClampedArray(stride * height - 13).fill(255);
        for (let v = 0; v < height; ++v) wide.set(data.subarray(v * width, (v + 1) * width), v * stride);
        const locator = await Locator.create();
        const fix = locator.locate({ data, width, height });
        assert.deepEqual((await Locator.create()).locate({ data: wide, width, height, stride }).bytes, fix.bytes);
    });

    test("sizes out of range have a status, too little data throws", async () => {
        const locator = await Locator.create();
        const data = new Uint8Array(5000 * 70);
        assert.equal(locator.locate({ data, width: 5000, height: 70 }).status, "image_too_large");
        assert.equal(locator.locate({ data, width: 60, height: 70 }).status, "image_too_small");
        assert.throws(() => locator.locate({ data: new Uint8Array(99), width: 188, height: 120 }), RangeError);
        assert.throws(() => locator.locate({ data, width: 188.5, height: 120 }), RangeError);
        assert.throws(() => locator.locate({ data, width: 188, height: 120, stride: 100 }), RangeError);
    });

    test("the spacing is that of the options; others are refused", async () => {
        const image = tools.render(kScene);
        const wide = (await Locator.create({ spacing_mm: 1.016 })).locate(image);
        assert.ok(Math.abs(wide.x_mm - 2 * 560) < 0.006);
        await assert.rejects(Locator.create({ code: "morse" }), RangeError);
        await assert.rejects(Locator.create({ max_p_wrong: 2 }), RangeError);
        await Locator.create({ bits_per_error: "measured" });
        await assert.rejects(Locator.create({ bits_per_error: "unknown" }), RangeError);
        await assert.rejects(Locator.create({ bits_per_error: 65537 }), RangeError);
        await assert.rejects(Locator.create({ bits_per_error: -1 }), RangeError);
        await assert.rejects(Locator.create({ bits_per_error: 0.001 }), RangeError);
        await assert.rejects(Locator.create({ attempts: 0 }), RangeError);
        await assert.rejects(Locator.create({ attempts: 3 }), RangeError);
    });

    test("dots and the map between image and pattern belong together", async () => {
        const fix = (await Locator.create({ dots: true })).locate(tools.render(kScene));
        assert.ok(fix.dots.length >= 2 * fix.dots_used && fix.dots_used > 100);
        const middle = dotpose.patternFromImage(fix, (188 - 1) / 2, (120 - 1) / 2);
        assert.ok(Math.abs(middle.x_mm - fix.x_mm) < 2e-5 && Math.abs(middle.y_mm - fix.y_mm) < 2e-5);
        let near = 0;
        for (let i = 0; i < fix.dots.length; i += 2) {
            const at = dotpose.patternFromImage(fix, fix.dots[i], fix.dots[i + 1]);
            const back = dotpose.imageFromPattern(fix, at.x_mm, at.y_mm);
            assert.ok(Math.hypot(back.u_px - fix.dots[i], back.v_px - fix.dots[i + 1]) < 1e-6);
            const off = [at.x_mm, at.y_mm].map((mm) => Math.abs(mm / 0.508 - Math.round(mm / 0.508)));
            // A dot is displaced from its intersection by a sixth of the spacing, along one axis.
            if (Math.abs(Math.max(...off) - 1 / 6) < 0.03 && Math.min(...off) < 0.03) ++near;
        }
        assert.ok(near > 0.95 * (fix.dots.length / 2), `${near} of ${fix.dots.length / 2}`);
    });

    test("follows a lens", async () => {
        const camera = { k: -4e-6 };
        const fix = (await Locator.create({ lens_k_per_px2: -4e-6 })).locate(tools.render({ ...kScene, camera }));
        assert.ok(fix.ok && Math.abs(fix.x_mm - 560) < 0.003);
        const corner = dotpose.patternFromImage(fix, 5, 7);
        const back = dotpose.imageFromPattern(fix, corner.x_mm, corner.y_mm);
        assert.ok(Math.hypot(back.u_px - 5, back.v_px - 7) < 1e-6);
    });
});

describe("Tracker", () => {
    const kSpeed_mm_s = 100;
    const kPeriod_us = 10_000;
    const x_mm = (k) => 560 + (k * kSpeed_mm_s * kPeriod_us) / 1e6;
    let tools;
    before(async () => (tools = await Tools.create()));

    /** Returns a tracker after 40 frames of a straight drive along x, without odometry. */
    async function driven() {
        const [tracker, locator] = [await Tracker.create(), await Locator.create()];
        let track;
        const attempts = [];
        for (let k = 0; k < 40; ++k) {
            const image = tools.render({ ...kScene, pose: { x_mm: x_mm(k), y_mm: 1070, theta_rad: 0.5 }, seed: k + 1 });
            const fix = locator.locate(image, { prediction: tracker.predict(k * kPeriod_us) });
            track = tracker.update(k * kPeriod_us, fix);
            assert.deepEqual(track.events, k === 0 ? ["fix"] : [], `frame ${k}`);
            attempts.push(fix.attempt);
        }
        return { tracker, track, attempts };
    }

    test("follows a drive, and predicts the next frame", async () => {
        const { track, attempts } = await driven();
        assert.equal(track.verdict, "accepted");
        assert.ok(Math.abs(track.x_mm - x_mm(39)) < 0.01 && Math.abs(track.y_mm - 1070) < 0.01, `${track.x_mm}, ${track.y_mm}`);
        assert.ok(Math.abs(track.theta_rad - 0.5) < 0.002);
        assert.ok(Math.abs(track.vx_mm_s - kSpeed_mm_s) < 1 && Math.abs(track.vy_mm_s) < 1, `${track.vx_mm_s}, ${track.vy_mm_s}`);
        // The robot moves by two spacings per frame. Predictions therefore succeed only once the
        // velocity is known, after the second frame.
        assert.deepEqual(new Set(attempts.slice(2)), new Set(["tracked"]));
    });

    test("odometry carries the pose on, with a covariance that grows", async () => {
        const [{ tracker, track }, { tracker: without }] = [await driven(), await driven()];
        const step_mm = (kSpeed_mm_s * kPeriod_us) / 1e6;
        // The image x axis is at an angle of 0.5 rad to the x axis of the pattern.
        const motion = {
            ...{ right_mm: step_mm * Math.cos(0.5), down_mm: -step_mm * Math.sin(0.5) },
            ...{ sigma_mm: 0.01, sigma_rad: 0.0005 },
        };
        let [carried, lost] = [track, track];
        for (let k = 40; k < 60; ++k) {
            carried = tracker.update(k * kPeriod_us, null, motion);
            lost = without.update(k * kPeriod_us, null);
            if (lost.events.includes("lost")) assert.equal(k, 39 + 7, "lost after 70 ms");
        }
        assert.equal(carried.is_lost, false);
        assert.equal(carried.verdict, "none");
        assert.ok(Math.abs(carried.x_mm - x_mm(59)) < 0.1, `${carried.x_mm}`);
        // The variance of x is the sum of two parts: twenty independent displacement errors of 0.01
        // mm, and the effect of heading errors.
        assert.ok(carried.covariance[0] > 0.9 * 20 * 0.01 ** 2 && carried.covariance[0] < 0.1 ** 2, `${carried.covariance[0]}`);
        assert.equal(lost.is_lost, true);
        assert.ok(Number.isNaN(lost.x_mm) && Number.isNaN(lost.covariance[0]));
        assert.equal(without.predict(600_000), null);
    });

    test("invalid arguments are refused with their names", async () => {
        const refused = (promise, message) => assert.rejects(promise, { name: "RangeError", message });
        await refused(Tracker.create({ max_sped_mm_s: 1 }), "a tracker has no option 'max_sped_mm_s'");
        await refused(Tracker.create({ confirmations: 2.5 }), "confirmations must be a whole number, not 2.5");
        await refused(Tracker.create({ still_mm: "1" }), "still_mm must be a number, not 1");
        await assert.rejects(Tracker.create({ max_speed_mm_s: -1 }), RangeError);
        const tracker = await Tracker.create({ max_speed_mm_s: 500, lost_after_us: 100_000 });
        assert.throws(() => tracker.update(0.5), /time_us must be a whole number, not 0.5/);
        assert.throws(() => tracker.update(0, null, { sigma_mm: 1 }), /motion.sigma_rad must be from 0/);
        assert.equal(tracker.update(0).is_lost, true);
    });
});

describe("sheets and the simulated camera", () => {
    let tools;
    let folder;
    before(async () => {
        tools = await Tools.create();
        folder = mkdtempSync(join(tmpdir(), "dotpose-"));
        process.on("exit", () => rmSync(folder, { recursive: true }));
    });
    const kSheet = { width_mm: 60, height_mm: 45, origin: { x: 70, y: 300 }, section: { u: 5, v: 61 }, code: "libdots" };
    const printed = (name) => {
        const path = join(folder, name);
        const options = ["--paper", "60x45", "--origin", "70,300", "--section", "5,61", "--code", "libdots"];
        execFileSync(kTool, ["print", "-o", path, ...options]);
        return readFileSync(path);
    };

    test("SVG has the bytes of the tool", () => assert.equal(tools.svg(kSheet), printed("sheet.svg").toString()));

    test("PNG has the pixels of the tool", async () => {
        const parts = (png) => {
            const found = {};
            for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at)) {
                const type = png.toString("latin1", at + 4, at + 8);
                const data = png.subarray(at + 8, at + 8 + png.readUInt32BE(at));
                found[type] = Buffer.concat([found[type] ?? Buffer.alloc(0), data]);
            }
            return { ...found, IDAT: inflateSync(found.IDAT) };
        };
        const ours = parts(Buffer.from(await tools.png(kSheet)));
        const theirs = parts(printed("sheet.png"));
        for (const type of ["IHDR", "pHYs"]) assert.deepEqual(ours[type], theirs[type], type);
        // Bits beyond the image width are undefined. The rows of this sheet do not end on a byte
        // boundary.
        const { width_px, height_px } = tools.raster(kSheet);
        const stride = Math.ceil(width_px / 8) + 1;
        const mask = 0xff00 >> (width_px % 8 || 8);
        for (let v = 0; v < height_px; ++v) {
            const lines = [ours, theirs].map(({ IDAT }) => {
                const line = Buffer.from(IDAT.subarray(v * stride, (v + 1) * stride));
                line[stride - 1] &= mask;
                return line;
            });
            assert.ok(lines[0].equals(lines[1]), `row ${v}`);
        }
    });

    test("dots lie where the code's symbols have them", async () => {
        const { columns, rows, origin_x_mm, origin_y_mm } = tools.layout(kSheet);
        const dots = tools.dots(kSheet);
        assert.equal(dots.length, 2 * columns * rows);
        const part = { code: kSheet.code, section: kSheet.section, cell: kSheet.origin, columns, rows };
        const symbols = await dotpose.patternBits(part);
        assert.equal(new Set(symbols).size, 4);
        symbols.forEach((symbol, i) => {
            const { dx, dy } = dotpose.kDisplacements[symbol];
            const x = origin_x_mm + ((i % columns) + dx / 6) * 0.508;
            const y = origin_y_mm + (Math.floor(i / columns) + dy / 6) * 0.508;
            assert.ok(Math.hypot(dots[2 * i] - x, dots[2 * i + 1] - y) < 1e-9);
        });
    });

    test("what cannot be done is said, and the next call works", () => {
        assert.throws(() => tools.svg({ margin_mm: 150 }), /a margin of 150 mm leaves nothing/);
        assert.throws(() => tools.raster({}, 100), /100 dpi is too low/);
        assert.throws(() => tools.render({ pose: { x_mm: 1, y_mm: 1, tilt_x_rad: 1.4 } }), /the tilt is too large/);
        assert.throws(() => tools.render({ pose: { x_mm: NaN, y_mm: 1 } }), RangeError);
        assert.equal(tools.layout().columns, 394);
    });

    test("every imperfection changes the image, and what is not given does not", () => {
        const clean = tools.render(kScene).data;
        const changed = (imperfections) => {
            const image = tools.render({ ...kScene, imperfections }).data;
            return image.filter((grey, i) => grey !== clean[i]).length;
        };
        assert.equal(changed({}), 0);
        const all = {
            ...{ paper_level: 190, ink_reflectance: 0.3, ink_variation: 0.1, palest_ink: 0.5, vignetting: 0.3 },
            ...{ fall: 0.4, blur_sigma_px: 0.8, motion_x_px: 2, motion_y_px: 2, noise_sigma: 4 },
            ...{ salt_and_pepper: 0.05, jitter_mm: 0.02, missing: 0.1, dirt_blobs: 5, graphics: 1, texture: 0.05 },
        };
        for (const [name, value] of Object.entries(all)) assert.ok(changed({ [name]: value }) > 20, name);
    });
});
