// Draws the map of all sheets.
import { arrow, themed } from "../draw/surface.js";
import type { Point_mm } from "../page/sheet_frame.js";
import { cornersOf, middleOf, type Placed, radians, worldOf } from "./sheets_geometry.js";
import type { Sheet } from "./sheets_messages.js";

export const kHandle_px = 9;
/** Distance from the upper edge of a sheet to the handle that turns it. */
export const kHandleReach_px = 26;

/**
 * The part of the world that the canvas shows: the world point in the middle, the scale in px per mm, and the canvas
 * size in px.
 */
export interface Frame {
    x_mm: number;
    y_mm: number;
    scale: number;
    width: number;
    height: number;
}

/** The robot on a sheet, in page coordinates. */
export interface RobotOnSheet {
    sheet: string;
    x_mm: number;
    y_mm: number;
    theta_deg: number;
}

export interface SheetStyle {
    is_selected: boolean;
    /** True if the handle that turns the sheet is drawn. */
    has_handle: boolean;
}

type Pixel = readonly [number, number];

function at(frame: Frame, { x_mm, y_mm }: Point_mm): Pixel {
    return [frame.width / 2 + (x_mm - frame.x_mm) * frame.scale, frame.height / 2 - (y_mm - frame.y_mm) * frame.scale];
}

export function worldAt({ x_mm, y_mm, scale, width, height }: Frame, u: number, v: number): Point_mm {
    return { x_mm: x_mm + (u - width / 2) / scale, y_mm: y_mm - (v - height / 2) / scale };
}

/** Returns the position of the handle that turns a sheet. */
export function handleOf(frame: Frame, { sheet, pose }: Placed): Pixel {
    const [u, v] = at(frame, worldOf(pose, sheet.width_mm / 2, 0));
    const yaw = radians(pose.yaw_deg);
    return [u - kHandleReach_px * Math.sin(yaw), v - kHandleReach_px * Math.cos(yaw)];
}

/**
 * Returns the grid step in mm: the smallest number of the form 1, 2 or 5 times a power of ten that corresponds to at
 * least 48 px on the canvas.
 */
function gridStep(scale: number): number {
    const kMin_px = 48;
    const power = 10 ** Math.floor(Math.log10(kMin_px / scale));
    return [1, 2, 5, 10].map((factor) => factor * power).find((step) => step * scale >= kMin_px)!;
}

/**
 * Returns the multiples of `step` between `from` and `to`, at most 200 of them. The limit matters only if the
 * coordinates are so large that their rounding errors exceed the step.
 */
function multiples(from: number, to: number, step: number): number[] {
    const kMax = 200;
    const first = Math.ceil(from / step);
    const count = Math.min(Math.floor(to / step) - first + 1, kMax);
    return Array.from({ length: Math.max(count, 0) || 0 }, (_, i) => (first + i) * step);
}

function line(context: CanvasRenderingContext2D, is_axis: boolean, from: Pixel, to: Pixel): void {
    context.strokeStyle = themed(is_axis ? "--soft" : "--line");
    context.beginPath();
    context.moveTo(...from);
    context.lineTo(...to);
    context.stroke();
}

function dot(context: CanvasRenderingContext2D, [u, v]: Pixel, radius: number): void {
    context.beginPath();
    context.arc(u, v, radius, 0, 2 * Math.PI);
    context.fill();
}

export function size({ width_mm, height_mm }: Sheet): string {
    return `${+width_mm.toFixed(1)} × ${+height_mm.toFixed(1)}`;
}

export function drawGrid(context: CanvasRenderingContext2D, frame: Frame): void {
    const { scale, width, height } = frame;
    const step_mm = gridStep(scale);
    const first = worldAt(frame, 0, height);
    const last = worldAt(frame, width, 0);
    context.lineWidth = 1;
    for (const x_mm of multiples(first.x_mm, last.x_mm, step_mm)) {
        const [u] = at(frame, { x_mm, y_mm: 0 });
        line(context, x_mm === 0, [u, 0], [u, height]);
    }
    for (const y_mm of multiples(first.y_mm, last.y_mm, step_mm)) {
        const [, v] = at(frame, { x_mm: 0, y_mm });
        line(context, y_mm === 0, [0, v], [width, v]);
    }
}

export function drawSheet(context: CanvasRenderingContext2D, frame: Frame, placed: Placed, { is_selected, has_handle }: SheetStyle): void {
    const { sheet, pose, is_known } = placed;
    const corners = cornersOf(sheet, pose).map((corner) => at(frame, corner));
    context.save();
    context.beginPath();
    corners.forEach(([u, v], i) => (i === 0 ? context.moveTo(u, v) : context.lineTo(u, v)));
    context.closePath();
    context.fillStyle = themed("--paper");
    context.globalAlpha = is_known ? 1 : 0.6;
    context.fill();
    context.globalAlpha = 1;
    if (!is_known || sheet.is_reserved) context.setLineDash([6, 4]);
    context.lineWidth = is_selected ? 3 : 1.5;
    context.strokeStyle = themed(is_selected ? "--accent" : "--soft");
    context.stroke();
    context.restore();
    // Marks the upper left corner, because the file contains the position of this corner.
    context.fillStyle = themed(is_selected ? "--accent" : "--soft");
    dot(context, corners[0]!, is_selected ? 5 : 3.5);
    drawName(context, frame, placed, corners);
    if (has_handle) drawHandle(context, frame, placed);
}

function drawName(context: CanvasRenderingContext2D, frame: Frame, { sheet, pose, is_known }: Placed, corners: readonly Pixel[]): void {
    const [u, v] = at(frame, middleOf(sheet, pose));
    const room = Math.max(Math.abs(corners[1]![0] - corners[3]![0]), Math.abs(corners[0]![0] - corners[2]![0]));
    const kMinRoom_px = 24;
    if (room < kMinRoom_px) return;
    const texts = [sheet.name, is_known ? `${size(sheet)} mm` : "no place yet", sheet.is_reserved ? "reserved" : ""].filter((text) => text !== "");
    context.textAlign = "center";
    context.textBaseline = "middle";
    texts.forEach((text, i) => {
        context.font = `${i === 0 ? 600 : 400} ${i === 0 ? 13 : 12}px system-ui, sans-serif`;
        context.fillStyle = themed(i === 0 ? "--text" : "--soft");
        if (i === 0 || context.measureText(text).width < room - 8) context.fillText(text, u, v + 16 * (i - (texts.length - 1) / 2), Math.max(room - 8, 40));
    });
}

function drawHandle(context: CanvasRenderingContext2D, frame: Frame, placed: Placed): void {
    const handle = handleOf(frame, placed);
    const edge = at(frame, worldOf(placed.pose, placed.sheet.width_mm / 2, 0));
    context.strokeStyle = context.fillStyle = themed("--accent");
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(...edge);
    context.lineTo(...handle);
    context.stroke();
    dot(context, handle, kHandle_px);
    context.strokeStyle = themed("--on-accent");
    context.beginPath();
    context.arc(handle[0], handle[1], kHandle_px / 2.2, -0.4, 1.4 * Math.PI);
    context.stroke();
}

/** Draws the robot. `on` is its sheet. */
export function drawRobot(context: CanvasRenderingContext2D, frame: Frame, robot: RobotOnSheet, on: Placed): void {
    const [u, v] = at(frame, worldOf(on.pose, robot.x_mm, robot.y_mm));
    // Angles on the page and on the canvas are clockwise.
    const angle = radians(robot.theta_deg - on.pose.yaw_deg);
    context.strokeStyle = themed("--strong");
    context.lineWidth = 2.5;
    arrow(context, [u, v], [u + 22 * Math.cos(angle), v + 22 * Math.sin(angle)], 7);
    context.fillStyle = themed("--good");
    dot(context, [u, v], 6);
    context.lineWidth = 2;
    context.strokeStyle = themed("--paper");
    context.stroke();
}

export function drawScale(context: CanvasRenderingContext2D, frame: Frame): void {
    const { scale, height } = frame;
    const step_mm = gridStep(scale);
    const [left, bottom] = [12, height - 12];
    context.fillStyle = themed("--ground");
    context.globalAlpha = 0.8;
    context.fillRect(left - 6, bottom - 24, step_mm * scale + 12, 30);
    context.globalAlpha = 1;
    context.strokeStyle = context.fillStyle = themed("--soft");
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(left, bottom - 5);
    context.lineTo(left, bottom);
    context.lineTo(left + step_mm * scale, bottom);
    context.lineTo(left + step_mm * scale, bottom - 5);
    context.stroke();
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "left";
    context.textBaseline = "bottom";
    context.fillText(step_mm >= 1000 ? `${step_mm / 1000} m` : `${step_mm} mm`, left + 4, bottom - 4);
}
