// Draws the sheet from above, with the path of the camera and its field of view.
import { patternFromImage, type Fix } from "dotpose";
import type { SheetLayout } from "../engine/messages.js";
import { kSpacing_mm, pageFromPattern, type Point_mm } from "../page/sheet_frame.js";
import { surfaceOf, themed } from "./surface.js";

/** Contents of the map, in mm on the page, or in the pattern if the sheet is unknown. */
export interface MapContent {
    sheet: SheetLayout | null;
    path: readonly Point_mm[];
    now: Point_mm | null;
    /** Corners of the camera's field of view. */
    view: readonly Point_mm[];
}

export interface MapFrame {
    scale: number;
    left_mm: number;
    top_mm: number;
}

/** Returns the corners of the field of view in pattern coordinates. */
export function cornersOf(fix: Fix, width_px: number, height_px: number): Point_mm[] {
    return [
        [0, 0],
        [width_px - 1, 0],
        [width_px - 1, height_px - 1],
        [0, height_px - 1],
    ].map(([u, v]) => patternFromImage(fix, u!, v!));
}

/**
 * Converts points of the pattern to points of the page. Returns them unchanged if the sheet is
 * unknown.
 */
export function onPage(sheet: SheetLayout | null, points: readonly Point_mm[]): Point_mm[] {
    return points.map((point) => (sheet ? pageFromPattern(sheet, point) : point));
}

function frameOf(content: MapContent, width: number, height: number): MapFrame {
    const kMargin = 10;
    let [left, top, right, bottom] = [0, 0, content.sheet?.width_mm ?? 0, content.sheet?.height_mm ?? 0];
    if (content.sheet === null) {
        const points = [...content.path, ...content.view];
        [left, right] = [Math.min(...points.map((p) => p.x_mm)), Math.max(...points.map((p) => p.x_mm))];
        [top, bottom] = [Math.min(...points.map((p) => p.y_mm)), Math.max(...points.map((p) => p.y_mm))];
    }
    const scale = Math.min((width - 2 * kMargin) / Math.max(right - left, 1), (height - 2 * kMargin) / Math.max(bottom - top, 1));
    return {
        scale,
        left_mm: (left + right) / 2 - width / 2 / scale,
        top_mm: (top + bottom) / 2 - height / 2 / scale,
    };
}

function drawPaper(context: CanvasRenderingContext2D, sheet: SheetLayout, at: (p: Point_mm) => [number, number]): void {
    const [x, y] = at({ x_mm: 0, y_mm: 0 });
    const [right, bottom] = at({ x_mm: sheet.width_mm, y_mm: sheet.height_mm });
    context.save();
    context.shadowColor = "rgba(0, 0, 0, 0.25)";
    context.shadowBlur = 12;
    context.shadowOffsetY = 3;
    context.fillStyle = themed("--paper");
    context.fillRect(x, y, right - x, bottom - y);
    context.restore();
    // Draws only every tenth dot of every tenth row.
    context.fillStyle = themed("--paper-dots");
    const kStep = 10;
    for (let row = 0; row < sheet.rows; row += kStep)
        for (let column = 0; column < sheet.columns; column += kStep) {
            const x_mm = sheet.first_x_mm + column * kSpacing_mm;
            const [u, v] = at({ x_mm, y_mm: sheet.first_y_mm + row * kSpacing_mm });
            context.fillRect(u - 0.5, v - 0.5, 1, 1);
        }
}

/** Draws the map. Returns its layout, or null if there is nothing to show. */
export function drawMap(canvas: HTMLCanvasElement, content: MapContent): MapFrame | null {
    const { context, width, height } = surfaceOf(canvas);
    if (content.sheet === null && content.path.length === 0) return null;
    const frame = frameOf(content, width, height);
    const at = ({ x_mm, y_mm }: Point_mm): [number, number] => [
        (x_mm - frame.left_mm) * frame.scale,
        (y_mm - frame.top_mm) * frame.scale,
    ];
    if (content.sheet) drawPaper(context, content.sheet, at);
    context.lineJoin = "round";
    context.lineCap = "round";
    if (content.path.length > 1) {
        context.strokeStyle = themed("--accent");
        context.globalAlpha = 0.65;
        context.lineWidth = 2;
        context.beginPath();
        content.path.forEach((point, i) => (i === 0 ? context.moveTo(...at(point)) : context.lineTo(...at(point))));
        context.stroke();
        context.globalAlpha = 1;
    }
    if (content.view.length > 0) {
        context.strokeStyle = themed("--strong");
        context.lineWidth = 1.5;
        context.beginPath();
        content.view.forEach((point, i) => (i === 0 ? context.moveTo(...at(point)) : context.lineTo(...at(point))));
        context.closePath();
        context.stroke();
    }
    if (content.now) {
        context.fillStyle = themed("--strong");
        context.strokeStyle = themed("--paper");
        context.lineWidth = 2;
        context.beginPath();
        context.arc(...at(content.now), 5, 0, 2 * Math.PI);
        context.fill();
        context.stroke();
    }
    return frame;
}
