// Compares the package with the golden files (wrappers/golden/README.md), in node and in browsers.

export const kSets = ["nominal", "hard", "vga"];

/** Yields the images of a stream of binary PGM files. */
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

/** Offsets in a dotpose_fix (wrappers/c/dotpose.h) of the columns, and how their numbers are written. */
const kColumns = [
    ...["int", [4, 8, 100, 104, 12]], // attempt, surface, dots used, bit errors, p_wrong_log2
    ...["natural", [88, 92, 112, 116, 120, 124]], // section, cell, fraction
    ...["int", [128, 132, 108, 196]], // theta, spacings, displacement
    ...["natural", [136, 140, 144, 148]], // place
    ...["int", Array.from({ length: 11 }, (_, i) => 152 + 4 * i)], // pattern_from_image
    ...["double", [16, 24, 32]], // x, y, theta
    ...["float", [84, ...Array.from({ length: 9 }, (_, i) => 200 + 4 * i)]], // residual, covariance
];

/** Returns the numbers of a fix as the lines of the golden files have them. */
function lineOf(fix) {
    const view = new DataView(fix.bytes.buffer);
    const hex = (value, digits) => value.toString(16).padStart(digits, "0");
    const read = {
        int: (at) => view.getInt32(at, true),
        natural: (at) => view.getUint32(at, true),
        double: (at) => hex(view.getBigUint64(at, true), 16),
        float: (at) => hex(view.getUint32(at, true), 8),
    };
    const numbers = [view.getInt32(0, true), fix.dots_seen];
    for (let i = 0; fix.ok && i < kColumns.length; i += 2)
        numbers.push(...kColumns[i + 1].map((at) => read[kColumns[i]](at)));
    return numbers.join(",");
}

/** Locates the frames of a set as its lines say; returns how many there are, and what differs in any bit. */
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
