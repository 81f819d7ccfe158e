// Makes frames that show the seam between two sheets. Each frame is composed of a simulated frame of the left sheet and
// a simulated frame of the right sheet.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { dotpose } from "./browser.mjs";

const kWidth_px = 376;
const kHeight_px = 240;
const kMmPerPx = 0.046;
const kSpacing_mm = 0.508;
const kSide_mm = 31;
const kFirst_mm = 0.5;
/**
 * Pose of the right sheet in the coordinates of the left page. The right sheet is shifted down and rotated clockwise.
 */
const kRight = { x_mm: 31.5, y_mm: 0.7, turn_rad: 0.012 };

function entry(name, origin_x) {
    const size = { columns: 60, rows: 60, width_mm: kSide_mm, height_mm: kSide_mm, first_x_mm: kFirst_mm, first_y_mm: kFirst_mm };
    const pattern = { code: "anoto", section_u: 0, section_v: 0, spacing_mm: kSpacing_mm, displacement_mm: kSpacing_mm / 6, dot_mm: kSpacing_mm / 6 };
    return { name, page: 1, origin_x, origin_y: 4096, ...size, ...pattern };
}

/** Returns the pixels of a frame whose centre is at a point on a page. */
function render(folder, sheet, { x_mm, y_mm }, theta_rad, seed) {
    const at = [sheet.origin_x + (x_mm - kFirst_mm) / kSpacing_mm, sheet.origin_y + (y_mm - kFirst_mm) / kSpacing_mm];
    const scene = ["--preset", "clean", "--size", `${kWidth_px}x${kHeight_px}`, "--mm-per-px", String(kMmPerPx), "--section", "0,0"];
    const angle_deg = (theta_rad * 180) / Math.PI;
    const name = join(folder, `${sheet.name}-${seed}`);
    dotpose("simulate", "-o", name, "--frames", "1", "--seed", String(seed), "--at", at.join(), "--angle", String(angle_deg), ...scene);
    return readFileSync(join(name, "frame_000000.pgm")).subarray(-kWidth_px * kHeight_px);
}

/** Converts coordinates on the left page to coordinates on the right page. */
function onRight({ x_mm, y_mm }) {
    const [c, s] = [Math.cos(kRight.turn_rad), Math.sin(kRight.turn_rad)];
    const [x, y] = [x_mm - kRight.x_mm, y_mm - kRight.y_mm];
    return { x_mm: c * x + s * y, y_mm: c * y - s * x };
}

function isOnDots({ x_mm, y_mm }) {
    const kLast_mm = kFirst_mm + 59.4 * kSpacing_mm;
    return Math.min(x_mm, y_mm) > kFirst_mm - 0.2 && Math.max(x_mm, y_mm) < kLast_mm;
}

/** Returns a frame centred on a point on the left page. */
function seamFrame(folder, at, theta_rad, seed) {
    const left = render(folder, entry("left", 2048), at, theta_rad, seed);
    const right = render(folder, entry("right", 6144), onRight(at), theta_rad - kRight.turn_rad, seed);
    const paper = Math.max(...left);
    const [c, s] = [Math.cos(theta_rad), Math.sin(theta_rad)];
    return left.map((level, i) => {
        const u_mm = ((i % kWidth_px) - (kWidth_px - 1) / 2) * kMmPerPx;
        const v_mm = (Math.floor(i / kWidth_px) - (kHeight_px - 1) / 2) * kMmPerPx;
        const point = { x_mm: at.x_mm + c * u_mm - s * v_mm, y_mm: at.y_mm + s * u_mm + c * v_mm };
        if (isOnDots(point)) return level;
        return isOnDots(onRight(point)) ? right[i] : paper;
    });
}

/**
 * Makes a sheet file with two sheets, and frames that show the seam between them. Only the left sheet has a pose in the
 * world. Returns the true pose of the right sheet.
 */
export function makeSeamFrames(folder) {
    mkdirSync(folder);
    const file = join(folder, "sheets.json");
    const left = { ...entry("left", 2048), world: { x_m: 0, y_m: 0, yaw_rad: 0 } };
    writeFileSync(file, JSON.stringify({ format: "dotpose-sheets", version: 1, sheets: [left, entry("right", 6144)] }));
    const frames = [];
    for (let i = 0; i < 14; ++i) frames.push(seamFrame(folder, { x_mm: 31.2, y_mm: 3 + 1.9 * i }, 0.5 * i, i + 1));
    return { file, frames, right: { x_mm: kRight.x_mm, y_mm: -kRight.y_mm, yaw_deg: (-kRight.turn_rad * 180) / Math.PI } };
}
