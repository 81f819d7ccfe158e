// Draws sheets from above, with the path of the camera and its field of view.
import type { SheetLayout } from "../engine/messages.js";
import { kSpacing_mm, type Point_mm } from "../page/sheet_frame.js";
import { arrow, surfaceOf, themed } from "./surface.js";

/** A page on the map. */
export interface Paper {
    name: string;
    corners: readonly Point_mm[];
    /** Layout of the dots. If it is undefined, no dots are drawn. */
    layout?: SheetLayout;
}

/** Contents of the map. Coordinates are in mm, relative to a page, the pattern or the world. */
export interface MapContent {
    papers: readonly Paper[];
    /** Parts of the path, separated by gaps. */
    strokes: readonly (readonly Point_mm[])[];
    now: Point_mm | null;
    /** Direction of the camera's x axis, from +x towards +y. Null if the direction is not drawn. */
    heading_rad: number | null;
    /** Corners of the camera's field of view. */
    view: readonly Point_mm[];
    /** True if y points up, as in the world. */
    y_up: boolean;
}

/**
 * Mapping from the plane to the canvas: scale in px per mm, and the plane point at the upper left corner of the canvas.
 */
export interface MapFrame {
    scale: number;
    left_mm: number;
    top_mm: number;
}

/** Returns the page for a layout, in page coordinates. */
export function paperOf(layout: SheetLayout): Paper {
    const { width_mm: x_mm, height_mm: y_mm } = layout;
    return { name: "", corners: [{ x_mm: 0, y_mm: 0 }, { x_mm, y_mm: 0 }, { x_mm, y_mm }, { x_mm: 0, y_mm }], layout };
}

function frameOf(content: MapContent, width: number, height: number): MapFrame {
    const kMargin = 10;
    const corners = content.papers.flatMap((paper) => paper.corners);
    const points = corners.length > 0 ? corners : [...content.strokes.flat(), ...content.view, ...(content.now ? [content.now] : [])];
    const side = (value: (point: Point_mm) => number, pick: "min" | "max") =>
        points.reduce((best, point) => Math[pick](best, value(point)), value(points[0]!));
    const [left, right] = [side((p) => p.x_mm, "min"), side((p) => p.x_mm, "max")];
    const [low, high] = [side((p) => p.y_mm, "min"), side((p) => p.y_mm, "max")];
    const scale = Math.min((width - 2 * kMargin) / Math.max(right - left, 1), (height - 2 * kMargin) / Math.max(high - low, 1));
    const middle = (low + high) / 2;
    return {
        scale,
        left_mm: (left + right) / 2 - width / 2 / scale,
        top_mm: content.y_up ? middle + height / 2 / scale : middle - height / 2 / scale,
    };
}

/** Converts a point on the plane to canvas coordinates, in px. */
export type ToCanvas = (point: Point_mm) => [number, number];

function trace(context: CanvasRenderingContext2D, points: readonly Point_mm[], at: ToCanvas): void {
    points.forEach((point, i) => (i === 0 ? context.moveTo(...at(point)) : context.lineTo(...at(point))));
}

/** Draws only every tenth dot of every tenth row. */
function drawDots(context: CanvasRenderingContext2D, sheet: SheetLayout, at: ToCanvas): void {
    context.fillStyle = themed("--paper-dots");
    const kStep = 10;
    for (let row = 0; row < sheet.rows; row += kStep)
        for (let column = 0; column < sheet.columns; column += kStep) {
            const x_mm = sheet.first_x_mm + column * kSpacing_mm;
            const [u, v] = at({ x_mm, y_mm: sheet.first_y_mm + row * kSpacing_mm });
            context.fillRect(u - 0.5, v - 0.5, 1, 1);
        }
}

export function drawPaper(context: CanvasRenderingContext2D, paper: Paper, at: ToCanvas): void {
    context.save();
    context.shadowColor = "rgba(0, 0, 0, 0.25)";
    context.shadowBlur = 12;
    context.shadowOffsetY = 3;
    context.fillStyle = themed("--paper");
    context.beginPath();
    trace(context, paper.corners, at);
    context.closePath();
    context.fill();
    context.restore();
    if (paper.layout) drawDots(context, paper.layout, at);
    if (paper.name === "") return;
    const middle = paper.corners.map(at).reduce(([u, v], [x, y]) => [u + x / 4, v + y / 4], [0, 0]);
    context.fillStyle = themed("--soft");
    context.font = "600 13px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillText(paper.name, ...(middle as [number, number]));
}

function drawStrokes(context: CanvasRenderingContext2D, strokes: MapContent["strokes"], at: ToCanvas): void {
    context.strokeStyle = themed("--accent");
    context.globalAlpha = 0.65;
    context.lineWidth = 2;
    context.beginPath();
    for (const stroke of strokes) trace(context, stroke, at);
    context.stroke();
    context.globalAlpha = 1;
}

function drawNow(context: CanvasRenderingContext2D, [x, y]: [number, number], angle: number | null): void {
    context.fillStyle = themed("--strong");
    context.strokeStyle = themed("--strong");
    if (angle !== null) {
        const kReach = 22;
        context.lineWidth = 2.5;
        arrow(context, [x, y], [x + kReach * Math.cos(angle), y + kReach * Math.sin(angle)], 7);
    }
    context.strokeStyle = themed("--paper");
    context.lineWidth = 2;
    context.beginPath();
    context.arc(x, y, 5, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
}

/** Draws the map. Returns its layout, or null if there is nothing to show. */
export function drawMap(canvas: HTMLCanvasElement, content: MapContent): MapFrame | null {
    const { context, width, height } = surfaceOf(canvas);
    if (content.papers.length === 0 && content.now === null && content.strokes.flat().length === 0) return null;
    const frame = frameOf(content, width, height);
    const sign = content.y_up ? -1 : 1;
    const at: ToCanvas = ({ x_mm, y_mm }) => [
        (x_mm - frame.left_mm) * frame.scale,
        sign * (y_mm - frame.top_mm) * frame.scale,
    ];
    for (const paper of content.papers) drawPaper(context, paper, at);
    context.lineJoin = "round";
    context.lineCap = "round";
    drawStrokes(context, content.strokes, at);
    if (content.view.length > 0) {
        context.strokeStyle = themed("--strong");
        context.lineWidth = 1.5;
        context.beginPath();
        trace(context, content.view, at);
        context.closePath();
        context.stroke();
    }
    if (content.now) {
        const heading = content.heading_rad === null ? null : sign * content.heading_rad;
        drawNow(context, at(content.now), heading);
    }
    return frame;
}
