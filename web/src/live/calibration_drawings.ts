// Draws the state of a calibration: uncovered parts of the image, directions, tilts, residuals, and turns of a robot.
import { arrow, surfaceOf, themed } from "../draw/surface.js";
import type { LensCoverage, Residuals, Station } from "./calibration_state.js";

const kMissing = "rgba(213, 60, 40, 0.34)";
/** Values at the rim of the tilt drawing: the change of the scale for a lens, and the tangent of the tilt for a pen. */
export const kMaxTilt = 0.15;
export const kMaxLean = Math.tan((45 * Math.PI) / 180);
/**
 * Lower limit of the residual that is represented by an arrow of maximum length. Arrows that show only noise therefore
 * stay short.
 */
const kMinFullScale_px = 0.05;

/** Marks the parts of the image in which no dots have been seen. The frame must already be on the canvas. */
export function drawMissing(canvas: HTMLCanvasElement, { columns, covered }: LensCoverage): void {
    const context = canvas.getContext("2d")!;
    const width = canvas.clientWidth / columns;
    const height = canvas.clientHeight / (covered.length / columns);
    context.fillStyle = kMissing;
    for (let i = 0; i < covered.length; ++i)
        if (covered[i] === "0") context.fillRect((i % columns) * width, Math.floor(i / columns) * height, width, height);
}

/**
 * Draws the sectors of a full turn, and an arrow in the direction of the newest frame. Sectors that have been seen have
 * a different colour. The first sector begins `begin` sectors after direction 0.
 */
export function drawTurns(canvas: HTMLCanvasElement, seen: readonly boolean[], theta_rad: number | null, begin = 0): void {
    const { context, width, height } = surfaceOf(canvas);
    const [x, y] = [width / 2, height / 2];
    const radius = Math.min(x, y) - 2;
    const sector = (2 * Math.PI) / seen.length;
    context.lineWidth = 1;
    seen.forEach((is_seen, i) => {
        context.beginPath();
        context.moveTo(x, y);
        context.arc(x, y, radius, (i + begin) * sector, (i + begin + 1) * sector);
        context.closePath();
        context.fillStyle = themed(is_seen ? "--good" : "--ground");
        context.fill();
        context.strokeStyle = themed("--soft");
        context.stroke();
    });
    if (theta_rad === null) return;
    context.strokeStyle = themed("--text");
    context.lineWidth = 3;
    arrow(context, [x, y], [x + 0.8 * radius * Math.cos(theta_rad), y + 0.8 * radius * Math.sin(theta_rad)], 9);
}

/** Draws the tilt of each frame as a point. A point in the middle represents no tilt. */
export function drawTilts(canvas: HTMLCanvasElement, tilts: readonly [number, number][], max: number): void {
    const { context, width, height } = surfaceOf(canvas);
    const [x, y] = [width / 2, height / 2];
    const radius = Math.min(x, y) - 2;
    context.strokeStyle = themed("--soft");
    context.lineWidth = 1;
    context.beginPath();
    for (const fraction of [1 / 3, 2 / 3, 1]) {
        context.moveTo(x + fraction * radius, y);
        context.arc(x, y, fraction * radius, 0, 2 * Math.PI);
    }
    context.moveTo(x - radius, y);
    context.lineTo(x + radius, y);
    context.moveTo(x, y - radius);
    context.lineTo(x, y + radius);
    context.stroke();
    context.fillStyle = themed("--accent");
    for (const [u, v] of tilts) {
        const per_tilt = (radius - 5) / Math.max(max, Math.hypot(u, v));
        context.beginPath();
        context.arc(x + u * per_tilt, y + v * per_tilt, 4, 0, 2 * Math.PI);
        context.fill();
    }
}

/** Returns the largest mean residual of any part of the image, but at least `kMinFullScale_px`. */
export function fullScale_px(residuals: readonly number[]): number {
    let full_px = kMinFullScale_px;
    for (let i = 0; i + 1 < residuals.length; i += 2) full_px = Math.max(full_px, Math.hypot(residuals[i]!, residuals[i + 1]!));
    return full_px;
}

/** Draws an arrow for the mean residual of each part of the image. */
export function drawResiduals(canvas: HTMLCanvasElement, { columns, rows }: Residuals, residuals: readonly number[], ink: string): void {
    const { context, width } = surfaceOf(canvas, columns / rows);
    const part = width / columns;
    const per_px = (0.95 * part) / fullScale_px(residuals);
    context.strokeStyle = themed(ink);
    context.lineWidth = 1.2;
    for (let i = 0; i < columns * rows; ++i) {
        const [u, v] = [residuals[2 * i]! * per_px, residuals[2 * i + 1]! * per_px];
        if (Math.hypot(u, v) < 0.5) continue;
        const [x, y] = [((i % columns) + 0.5) * part, (Math.floor(i / columns) + 0.5) * part];
        arrow(context, [x, y], [x + u, y + v], Math.min(4, 0.4 * Math.hypot(u, v)));
    }
}

/** Draws the camera's pose in each frame of a turn, around the centre of rotation. */
export function drawSpin(canvas: HTMLCanvasElement, stations: readonly Station[]): void {
    const { context, width, height } = surfaceOf(canvas);
    const [x, y] = [width / 2, height / 2];
    const reach_mm = Math.max(1e-3, ...stations.map(([x_mm, y_mm]) => Math.hypot(x_mm, y_mm)));
    const per_mm = (Math.min(x, y) - 26) / reach_mm;
    context.lineWidth = 1;
    for (const [x_mm, y_mm, theta_rad] of stations) {
        const at: [number, number] = [x + x_mm * per_mm, y + y_mm * per_mm];
        context.strokeStyle = themed("--line");
        context.beginPath();
        context.moveTo(x, y);
        context.lineTo(...at);
        context.stroke();
        context.strokeStyle = themed("--accent");
        context.lineWidth = 2;
        arrow(context, at, [at[0] + 18 * Math.cos(theta_rad), at[1] + 18 * Math.sin(theta_rad)], 6);
        context.lineWidth = 1;
        context.fillStyle = themed("--accent");
        context.beginPath();
        context.arc(...at, 4, 0, 2 * Math.PI);
        context.fill();
    }
    context.fillStyle = themed("--warn");
    context.beginPath();
    context.arc(x, y, 6, 0, 2 * Math.PI);
    context.fill();
}
