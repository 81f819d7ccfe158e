// Compares the package with the golden files (wrappers/golden/README.md), in Node and in browsers.

export const kSets = ["nominal", "hard", "vga"];

/** Yields the images in a stream of binary PGM files. */
export function* imagesOf(buffer) {
    const bytes = new Uint8Array(buffer);
    for (let at = 0; at < bytes.length; ) {
        const header = /^P5\n(\d+) (\d+)\n255\n/.exec(String.fromCharCode(...bytes.subarray(at, at + 32)));
        const [width, height] = [Number(header[1]), Number(header[2])];
        const first = at + header[0].length;
        at = first + width * height;
        yield { data: bytes.subarray(first, at), width, height };
    }
}

/** Types, counts and offsets of the columns in a dotpose_fix (wrappers/c/dotpose.h). */
const kColumns = [
    ["double", 1, 8], // x_mm
    ["double", 1, 16], // y_mm
    ["double", 1, 24], // theta_rad
    ["double", 1, 32], // p_wrong
    ["int", 1, 40], // p_wrong_log2
    ["int", 1, 44], // dots_seen
    ["int", 1, 48], // dots_used
    ["int", 1, 52], // attempt
    ["int", 1, 56], // surface
    ["int", 1, 60], // bit_errors
    ["float", 1, 64], // residual_px
    ["float", 9, 68], // covariance
    ["natural", 1, 104], // section_u
    ["natural", 1, 108], // section_v
    ["natural", 1, 112], // cell_x
    ["natural", 1, 116], // cell_y
    ["natural", 1, 120], // fraction_x_q16
    ["natural", 1, 124], // fraction_y_q16
    ["int", 1, 128], // theta_bam
    ["int", 1, 132], // spacing_px_q16
    ["int", 1, 136], // spacing_nm
    ["natural", 4, 140], // place
    ["int", 11, 156], // pattern_from_image
    ["int", 1, 200], // displacement_q16
    ["float", 9, 204], // covariance_grid
    ["int", 1, 240], // prior
    ["int", 1, 244], // frames
    ["float", 1, 248], // readout_turn_rad
];

/** Returns the numbers in a fix, in the format of the lines in a golden file. */
function lineOf(fix) {
    const view = new DataView(fix.bytes.buffer);
    const hex = (value, digits) => value.toString(16).padStart(digits, "0");
    const read = {
        int: (at) => view.getInt32(at, true),
        natural: (at) => view.getUint32(at, true),
        double: (at) => hex(view.getBigUint64(at, true), 16),
        float: (at) => hex(view.getUint32(at, true), 8),
    };
    const numbers = [view.getInt32(4, true), fix.dots_seen];
    for (const [type, count, at] of fix.ok ? kColumns : [])
        for (let i = 0; i < count; ++i) numbers.push(read[type](at + i * (type === "double" ? 8 : 4)));
    return numbers.join(",");
}

/**
 * Locates the frames of a set with every method in the golden file except "device". Returns the
 * numbers of lines, fixes and tracked fixes, and the lines whose results are not bit-identical.
 */
export async function compareSet({ Locator }, frames, csv, wasm) {
    const images = [...imagesOf(frames)];
    const locator = await Locator.create({ code: "anoto", wasm });
    const counts = { lines: 0, ok: 0, tracked: 0, different: [] };
    let before;
    for (const line of csv.trim().split("\n")) {
        const [, index, way, expected] = /^(\d+),(\w+),(.*)$/.exec(line);
        if (way === "device") continue;
        const image = images[2 * index + (way === "tracked" ? 1 : 0)];
        let fix;
        if (way === "locate") before = fix = locator.locate(image);
        else if (way === "tracked") fix = locator.locate(image, { prediction: before });
        else fix = (await Locator.create({ wasm })).locate(image);
        ++counts.lines;
        counts.ok += fix.ok ? 1 : 0;
        counts.tracked += fix.ok && fix.attempt === "tracked" ? 1 : 0;
        if (lineOf(fix) !== expected) counts.different.push(`${line}\n${lineOf(fix)}`);
    }
    return counts;
}
