// Geometry of pages in the world. Computes the corners of pages, and moves and turns their poses. In the world, y
// points up. On pages, y points down.
import type { Point_mm } from "../page/sheet_frame.js";
import type { Pose, Sheet } from "./sheets_messages.js";

export function radians(deg: number): number {
    return (deg * Math.PI) / 180;
}

/** Returns the equivalent angle in (-180, 180]. */
export function wrapped_deg(deg: number): number {
    const turn = ((deg % 360) + 360) % 360;
    return turn > 180 ? turn - 360 : turn;
}

/** Converts a point on the page to world coordinates. */
export function worldOf(pose: Pose, x_mm: number, y_mm: number): Point_mm {
    const [c, s] = [Math.cos(radians(pose.yaw_deg)), Math.sin(radians(pose.yaw_deg))];
    return { x_mm: pose.x_mm + c * x_mm + s * y_mm, y_mm: pose.y_mm + s * x_mm - c * y_mm };
}

/** Converts a point in the world to page coordinates. */
export function pageOf(pose: Pose, point: Point_mm): Point_mm {
    const [c, s] = [Math.cos(radians(pose.yaw_deg)), Math.sin(radians(pose.yaw_deg))];
    const [x, y] = [point.x_mm - pose.x_mm, point.y_mm - pose.y_mm];
    return { x_mm: c * x + s * y, y_mm: s * x - c * y };
}

export function cornersOf(sheet: Sheet, pose: Pose): Point_mm[] {
    const { width_mm: w, height_mm: h } = sheet;
    return [worldOf(pose, 0, 0), worldOf(pose, w, 0), worldOf(pose, w, h), worldOf(pose, 0, h)];
}

export function middleOf(sheet: Sheet, pose: Pose): Point_mm {
    return worldOf(pose, sheet.width_mm / 2, sheet.height_mm / 2);
}

export function isOn(sheet: Sheet, pose: Pose, point: Point_mm): boolean {
    const { x_mm, y_mm } = pageOf(pose, point);
    return x_mm >= 0 && y_mm >= 0 && x_mm <= sheet.width_mm && y_mm <= sheet.height_mm;
}

function round(value: number, step: number): number {
    // For decimal steps such as 0.1, division by the inverse yields the nearest double.
    const inverse = Math.round(1 / step);
    return Math.round(value * inverse) / inverse;
}

/** Rounds the position of a pose to 0.1 mm, and its angle to 0.1 degrees. */
export function rounded(pose: Pose): Pose {
    return { x_mm: round(pose.x_mm, 0.1), y_mm: round(pose.y_mm, 0.1), yaw_deg: round(wrapped_deg(pose.yaw_deg), 0.1) };
}

export function moved(pose: Pose, x_mm: number, y_mm: number): Pose {
    return { ...pose, x_mm: pose.x_mm + x_mm, y_mm: pose.y_mm + y_mm };
}

/** Turns a page about its middle. */
export function turned(sheet: Sheet, pose: Pose, yaw_deg: number): Pose {
    const middle = middleOf(sheet, pose);
    const at_origin = { x_mm: 0, y_mm: 0, yaw_deg };
    const offset = middleOf(sheet, at_origin);
    return { x_mm: middle.x_mm - offset.x_mm, y_mm: middle.y_mm - offset.y_mm, yaw_deg };
}

interface Box {
    left: number;
    right: number;
    low: number;
    high: number;
}

export function boxOf(points: readonly Point_mm[]): Box {
    const box = { left: Infinity, right: -Infinity, low: Infinity, high: -Infinity };
    for (const { x_mm, y_mm } of points) {
        box.left = Math.min(box.left, x_mm);
        box.right = Math.max(box.right, x_mm);
        box.low = Math.min(box.low, y_mm);
        box.high = Math.max(box.high, y_mm);
    }
    return box;
}

/** A sheet, and the pose at which the map draws it. */
export interface Placed {
    sheet: Sheet;
    pose: Pose;
    /**
     * False if the pose of the sheet in the world is not known. The map then draws the sheet below the other sheets.
     */
    is_known: boolean;
}

/**
 * Returns all sheets, each with the pose at which it is drawn. Sheets without a pose in the world are arranged in rows
 * below the other sheets.
 */
export function layOut(sheets: readonly Sheet[]): Placed[] {
    const known: Placed[] = sheets.filter(({ world }) => world).map((sheet) => ({ sheet, pose: sheet.world!, is_known: true }));
    const unknown = sheets.filter(({ world }) => !world);
    const box = known.length > 0 ? boxOf(known.flatMap(({ sheet, pose }) => cornersOf(sheet, pose))) : null;
    const gap_mm = Math.max(...unknown.map(({ width_mm }) => width_mm), 0) / 8;
    const columns = Math.max(Math.ceil(Math.sqrt(unknown.length * 2)), 3);
    let [x_mm, y_mm, row_mm] = [box?.left ?? 0, box ? box.low - 2 * gap_mm : 0, 0];
    const placed = unknown.map((sheet, i) => {
        if (i > 0 && i % columns === 0) [x_mm, y_mm, row_mm] = [box?.left ?? 0, y_mm - row_mm - gap_mm, 0];
        const pose = { x_mm, y_mm, yaw_deg: 0 };
        x_mm += sheet.width_mm + gap_mm;
        row_mm = Math.max(row_mm, sheet.height_mm);
        return { sheet, pose, is_known: false };
    });
    return [...known, ...placed];
}
