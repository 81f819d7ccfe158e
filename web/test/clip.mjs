// Makes clips for Chromium's fake camera from simulated frames with known poses.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { dotpose } from "./browser.mjs";

/** Returns the lines of a CSV file as objects. Numeric fields are converted to numbers. */
export function readCsv(text) {
    const [head, ...lines] = text.trim().split("\n").map((line) => line.split(","));
    const value = (field) => (field !== "" && Number.isFinite(Number(field)) ? Number(field) : field);
    return lines.map((line) => Object.fromEntries(head.map((name, i) => [name, value(line[i])])));
}

/** Returns the size and pixels of a binary PGM file written by the command-line tool. */
function readPgm(bytes) {
    const [, width, height] = /^P5\s+(\d+)\s+(\d+)\s+255\s/.exec(bytes.subarray(0, 64).toString("latin1")).map(Number);
    return { width, height, pixels: bytes.subarray(bytes.length - width * height) };
}

/**
 * Writes `clip.y4m` to the folder. For each frame, returns the true pose, the tool's output line for the luma of the
 * frame (`tool`), and the frame as a PNG file (`png`). `options` are additional options for `dotpose simulate`.
 */
export function makeClip(folder, { frames, size, options = [] }) {
    const still = join(folder, "frames");
    dotpose("simulate", "-o", still, "--frames", String(frames), "--seed", "5", "--size", size, ...options);
    const truth = readCsv(readFileSync(join(still, "truth.csv"), "utf8"));
    const [width, height] = size.split("x").map(Number);
    const chroma = Buffer.alloc((width * height) / 2, 128);
    const parts = [Buffer.from(`YUV4MPEG2 W${width} H${height} F30:1 Ip A1:1 C420jpeg\n`)];
    const lumas = [];
    for (const { file } of truth) {
        const { pixels } = readPgm(readFileSync(join(still, file)));
        // Chromium expects luma in the limited range from 16 to 235.
        const luma = Buffer.from(pixels, 0).map((level) => 16 + Math.round((level * 219) / 255));
        parts.push(Buffer.from("FRAME\n"), luma, chroma);
        const path = join(folder, `luma_${file}`);
        writeFileSync(path, Buffer.concat([Buffer.from(`P5\n${width} ${height}\n255\n`), luma]));
        lumas.push(path);
    }
    writeFileSync(join(folder, "clip.y4m"), Buffer.concat(parts));
    const read = dotpose("locate", ...lumas).trim().split("\n").map((line) => JSON.parse(line));
    return truth.map((pose, i) => ({ ...pose, tool: read[i], png: pngOf(join(still, pose.file)) }));
}

function pngOf(pgm) {
    return execFileSync("ffmpeg", ["-loglevel", "error", "-i", pgm, "-f", "image2pipe", "-c:v", "png", "-"]);
}
