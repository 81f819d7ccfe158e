// Tests print maps in Node. Compares fixes and poses with the results of the command-line tool for
// the same map.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { dotpose, kTool, Tools } from "./installed.mjs";

const kPage_mm = 35;
const kSpacing_mm = 0.508;
const kOrigin = { x: 5000, y: 7000 };
const kDistance_mm = 25;
const kCamera = { width_px: 320, height_px: 240, mm_per_px: 0.046, working_distance_mm: kDistance_mm };
const kFocal_px = kDistance_mm / kCamera.mm_per_px;
const kSheet = { width_mm: kPage_mm, height_mm: kPage_mm, margin_mm: 0, origin: kOrigin };

/** Returns a generator of pseudo-random numbers from 0 to 1. The sequence is the same in every
 * run. */
function random(seed) {
    let state = seed;
    return () => (state = (state * 48271) % 0x7fffffff) / 0x7fffffff;
}

/** Returns the CRC-32 (IEEE 802.3) of the bytes. A map file ends with this checksum. */
function crc32(bytes) {
    let crc = 0xffffffff;
    for (const byte of bytes) {
        crc ^= byte;
        for (let bit = 0; bit < 8; ++bit) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return ~crc >>> 0;
}

/** Returns a map file with the correct checksum. */
function withSum(bytes) {
    const end = bytes.length - 4;
    new DataView(bytes.buffer).setUint32(end, crc32(bytes.subarray(0, end)), true);
    return bytes;
}

/**
 * Returns the offset of the first page's column count in a map file (docs/print-map.md). `name` is
 * the name of the page's sheet.
 */
const columnsAt = (name) => 20 + name.length + 3 + 8;
/** Returns the offset of the first page's array of view counts, which has one element per dot. */
const viewsAt = (name, dots) => columnsAt(name) + 8 + 8 + 4 + 16 + 4 * dots;

const near = (expected, actual, tolerance) =>
    assert.ok(Math.abs(actual - expected) <= tolerance, `${actual}, not ${expected}`);

describe("print map", () => {
    let folder;
    let tools;
    let print_map;
    let options;
    let locator;

    /**
     * Returns a frame of a print whose dots have random position errors with a standard deviation
     * of 20 um.
     */
    const render = (pose, seed, page_seed = 5) =>
        tools.render({
            ...{ sheet: kSheet, page_seed, camera: kCamera, seed },
            pose: { ...pose, x_mm: kOrigin.x * kSpacing_mm + pose.x_mm, y_mm: kOrigin.y * kSpacing_mm + pose.y_mm },
            imperfections: { jitter_mm: 0.02, noise_sigma: 3, blur_sigma_px: 0.7 },
        });
    const write = (name, { data, width, height }) =>
        writeFileSync(join(folder, name), Buffer.concat([Buffer.from(`P5\n${width} ${height}\n255\n`), data]));
    const run = (...args) => execFileSync(kTool, args, { cwd: folder, encoding: "utf8", stdio: "pipe" });

    before(async () => {
        folder = mkdtempSync(join(tmpdir(), "dotpose-"));
        tools = await Tools.create();
        const origin = `${kOrigin.x},${kOrigin.y}`;
        const size = `${kPage_mm}x${kPage_mm}`;
        run("print", "-o", "page.svg", "--paper", size, "--margin", "0", "--origin", origin, "--sheets", "sheets.json", "--name", "page");
        mkdirSync(join(folder, "frames"));
        const next = random(1);
        for (let k = 0; k < 80; ++k) {
            const place = () => 6 + (kPage_mm - 12) * next();
            write(`frames/${k}.pgm`, render({ x_mm: place(), y_mm: place(), theta_rad: 6.28 * next() }, k + 1));
        }
        run("calibrate", "--print-map", "frames", "--sheets", "sheets.json", "-o", "page.map");
        print_map = new Uint8Array(readFileSync(join(folder, "page.map")));
        const { columns, rows } = tools.layout(kSheet);
        options = { sheets: [{ first: kOrigin, columns, rows }], code: "anoto", print_map };
        locator = await dotpose.Locator.create(options);
    });
    after(() => rmSync(folder, { recursive: true }));

    test("fixes are those of the tool, and more accurate than without the map", async () => {
        const without = await dotpose.Locator.create({ ...options, print_map: undefined });
        // The page fills the frame in all poses. Otherwise, the results would differ, because only
        // the tool removes the area around the page.
        const next = random(2);
        let [squares, squares_without] = [0, 0];
        for (let k = 0; k < 6; ++k) {
            const pose = { x_mm: 11 + 13 * next(), y_mm: 11 + 13 * next(), theta_rad: 6.28 * next() };
            const image = render(pose, 100 + k);
            write("frame.pgm", image);
            const tool_line = JSON.parse(run("locate", "--sheets", "sheets.json", "--print-map", "page.map", "frame.pgm"));
            const fix = locator.locate(image);
            assert.equal(fix.map_use, "used");
            // With a different compiler, a result may be rounded to a neighbouring multiple of
            // 2^-16 spacings (8 nm).
            near(tool_line.x_mm, fix.x_mm, 1e-5);
            near(tool_line.y_mm, fix.y_mm, 1e-5);
            near(tool_line.theta_deg, (fix.theta_rad * 180) / Math.PI, 1e-6);
            near(tool_line.residual_px, fix.residual_px, 1e-4);
            near(tool_line.covariance_mm_deg[0], fix.covariance[0], 1e-5 * fix.covariance[0]);
            const error = (seen) => Math.hypot(seen.x_mm - pose.x_mm - kOrigin.x * kSpacing_mm, seen.y_mm - pose.y_mm - kOrigin.y * kSpacing_mm);
            squares += error(fix) ** 2;
            squares_without += error(without.locate(image)) ** 2;
        }
        assert.ok(squares < squares_without / 4, `${squares}, ${squares_without}`);
    });

    test("poses in space are those of the tool", async () => {
        const camera = `format: dotpose-camera\nversion: 1\nwidth_px: 320\nheight_px: 240\nk_per_px2: 0\ncentre_px: [159.5, 119.5]\nfocal_px: ${kFocal_px}\n`;
        writeFileSync(join(folder, "camera.yaml"), camera);
        const image = render({ x_mm: 17, y_mm: 18, tilt_y_rad: 0.3 }, 200);
        write("frame.pgm", image);
        const tool_line = JSON.parse(run("locate", "--sheets", "sheets.json", "--print-map", "page.map", "--camera", "camera.yaml", "--pose", "space", "frame.pgm"));
        const both = await dotpose.Locator.create({ ...options, space: { focal_px: kFocal_px } });
        const { map_use, space } = both.locate(image);
        assert.equal(map_use, "used");
        ["x", "y", "z"].forEach((axis, i) => near(tool_line[`camera_${axis}_mm`], space.position_mm[i], 1e-6));
        tool_line.camera_quaternion_xyzw.forEach((value, i) => near(value, space.quaternion_xyzw[i], 1e-9));
        near(tool_line.camera_tilt_deg, (space.tilt_rad * 180) / Math.PI, 1e-6);
        assert.equal(space.dots, tool_line.camera_dots);
        // Without the map, the residuals contain the print errors.
        const without = await dotpose.Locator.create({ ...options, print_map: undefined, space: { focal_px: kFocal_px } });
        assert.ok(without.locate(image).space.residual_px > 5 * space.residual_px);
    });

    test("a map that does not fit is not used, and the reason is reported", async () => {
        const pose = { x_mm: 17, y_mm: 18 };
        const another = render(pose, 300, 6);
        const fix = locator.locate(another);
        assert.equal(fix.map_use, "contradicted");
        const without = await dotpose.Locator.create({ ...options, print_map: undefined });
        assert.deepEqual(without.locate(another).bytes, fix.bytes);
        assert.equal(without.locate(another).map_use, "no_map");
        const elsewhere = tools.render({ camera: kCamera, pose: { x_mm: 30, y_mm: 40 } });
        assert.equal(locator.locate(elsewhere).map_use, "no_map");
        assert.equal(locator.locate(elsewhere).ok, true);
        const unseen = print_map.slice();
        const { columns, rows } = tools.layout(kSheet);
        const views = viewsAt("page", columns * rows);
        unseen.fill(0, views, views + columns * rows);
        const blind = await dotpose.Locator.create({ ...options, print_map: withSum(unseen) });
        assert.equal(blind.locate(render(pose, 301)).map_use, "not_covered");
        const blank = { data: new Uint8Array(320 * 240).fill(200), width: 320, height: 240 };
        assert.deepEqual([locator.locate(blank).ok, locator.locate(blank).map_use], [false, "no_map"]);
    });

    test("files that are not a map are refused with the reason", async () => {
        const refused = (bytes, message) =>
            assert.rejects(dotpose.Locator.create({ print_map: bytes }), { name: "RangeError", message });
        await refused(new Uint8Array(0), "it is not a print map of dotpose");
        await refused(print_map.slice(0, 1000), /its checksum is wrong; make the map again/);
        const damaged = print_map.slice();
        damaged[500] ^= 1;
        await refused(damaged, /its checksum is wrong/);
        const newer = print_map.slice();
        newer[8] = 99;
        await refused(newer, /^it has version 99, and this program reads versions 1 to \d+/);
        // The number of dots on the page is 2^32, which does not fit in the module's 32-bit size_t.
        const huge = print_map.slice();
        const columns = columnsAt("page");
        new DataView(huge.buffer).setUint32(columns, 65536, true);
        new DataView(huge.buffer).setUint32(columns + 4, 65536, true);
        await refused(withSum(huge), "a page is too large");
    });
});
