// Draws robots on a map. Each condition has its own shape and colour.
import { themed } from "../draw/surface.js";
import { kConditions, type Condition, type Positions, type Track, type Trails } from "./messages.js";
import type { TrailEnds } from "./trail_ends.js";
import type { Viewport } from "./viewport.js";

/** Names of the colours in the style sheet. */
const kInk: Record<Condition, string> = {
    moving: "--accent",
    still: "--good",
    lost: "--lost",
    silent: "--silent",
    gone: "--soft",
};
/** Symbols that represent the conditions in text. */
export const kSymbols: Record<Condition, string> = { moving: "▲", still: "●", lost: "○", silent: "✕", gone: "·" };

/** Order in which the conditions are drawn. Robots that need attention are drawn last, on top of the others. */
export const kDrawingOrder: readonly Condition[] = ["gone", "still", "moving", "lost", "silent"];
/** Half the side length of the square around a robot on an unknown sheet, relative to the radius of the mark. */
export const kSquare = 1.8;

/** Returns the radius of a mark. It decreases with the number of robots in view. */
export function radiusFor(count: number): number {
    return count > 500 ? 3.5 : count > 100 ? 5 : 7;
}

/** Adds a mark to the current path of the canvas. `angle` is the heading on the canvas, or null. */
export function addMark(context: CanvasRenderingContext2D, condition: Condition, x: number, y: number, angle: number | null, r: number): void {
    if (condition === "silent") {
        context.moveTo(x - r, y - r);
        context.lineTo(x + r, y + r);
        context.moveTo(x - r, y + r);
        context.lineTo(x + r, y - r);
    } else if (condition === "moving" && angle !== null) {
        const [cos, sin] = [r * Math.cos(angle), r * Math.sin(angle)];
        // Does not use closePath, which in Chromium takes time proportional to the length of the path.
        context.moveTo(x + 1.5 * cos, y + 1.5 * sin);
        context.lineTo(x - cos - 0.9 * sin, y - sin + 0.9 * cos);
        context.lineTo(x - cos + 0.9 * sin, y - sin - 0.9 * cos);
        context.lineTo(x + 1.5 * cos, y + 1.5 * sin);
    } else {
        const radius = condition === "gone" ? r / 2 : r;
        context.moveTo(x + radius, y);
        context.arc(x, y, radius, 0, 2 * Math.PI);
    }
}

/** Paints the marks that the current path contains. */
export function paintMarks(context: CanvasRenderingContext2D, condition: Condition): void {
    const is_outline = condition === "lost" || condition === "silent";
    context.lineWidth = is_outline ? 2.5 : 1;
    context.fillStyle = themed(kInk[condition]);
    context.strokeStyle = is_outline ? context.fillStyle : themed("--paper");
    if (!is_outline) context.fill();
    context.stroke();
}

/** Paints the squares that the current path contains. */
export function paintSquares(context: CanvasRenderingContext2D): void {
    context.strokeStyle = themed("--warn");
    context.lineWidth = 1.5;
    context.stroke();
}

/** Draws all robots. Robots on sheets that the sheet file does not contain get a square around them. */
export function drawRobots(context: CanvasRenderingContext2D, positions: Positions, view: Viewport): void {
    const r = radiusFor(positions.count);
    const sign = view.y_up ? -1 : 1;
    for (const condition of kDrawingOrder) {
        const index = kConditions.indexOf(condition);
        context.beginPath();
        for (let i = 0; i < positions.count; ++i) {
            if (positions.condition(i) !== index) continue;
            const angle = positions.hasHeading(i) ? sign * positions.heading_rad(i) : null;
            addMark(context, condition, view.x(positions.x_mm(i)), view.y(positions.y_mm(i)), angle, r);
        }
        paintMarks(context, condition);
    }
    context.beginPath();
    for (let i = 0; i < positions.count; ++i) {
        if (!positions.isUnknown(i)) continue;
        const [x, y] = [view.x(positions.x_mm(i)), view.y(positions.y_mm(i))];
        context.rect(x - kSquare * r, y - kSquare * r, 2 * kSquare * r, 2 * kSquare * r);
    }
    paintSquares(context);
}

/** Draws the names of the robots, unless there is too little room for them. */
export function drawNames(context: CanvasRenderingContext2D, positions: Positions, view: Viewport): void {
    const kArea_px = 6000;
    const { names, count } = positions;
    if (names === undefined || count * kArea_px > view.width * view.height) return;
    context.font = "600 12px system-ui, sans-serif";
    context.textAlign = "left";
    context.textBaseline = "middle";
    context.lineWidth = 3;
    context.lineJoin = "round";
    context.strokeStyle = themed("--card");
    context.fillStyle = themed("--text");
    for (let i = 0; i < count; ++i) {
        const [x, y] = [view.x(positions.x_mm(i)) + 12, view.y(positions.y_mm(i)) - 10];
        context.strokeText(names[i]!, x, y);
        context.fillText(names[i]!, x, y);
    }
}

/** Draws the trails. */
export function drawTrails(context: CanvasRenderingContext2D, { trails_mm }: Trails, view: Viewport): void {
    context.strokeStyle = themed("--accent");
    context.globalAlpha = 0.35;
    context.lineWidth = trails_mm.size > 500 ? 1 : 2;
    context.beginPath();
    for (const trail of trails_mm.values()) addLine(context, trail, view);
    context.stroke();
    context.globalAlpha = 1;
}

/** Draws the path of each robot from the end of its trail to its newest position. */
export function drawTrailEnds(context: CanvasRenderingContext2D, { trails, ends_mm }: TrailEnds, view: Viewport): void {
    context.strokeStyle = themed("--accent");
    context.globalAlpha = 0.35;
    context.lineWidth = (trails?.trails_mm.size ?? 0) > 500 ? 1 : 2;
    context.beginPath();
    for (const end of ends_mm) addLine(context, end, view);
    context.stroke();
    context.globalAlpha = 1;
}

function addLine(context: CanvasRenderingContext2D, line_mm: ArrayLike<number>, view: Viewport): void {
    for (let k = 0; k + 1 < line_mm.length; k += 2) {
        const [x, y] = [view.x(line_mm[k]!), view.y(line_mm[k + 1]!)];
        if (k === 0) context.moveTo(x, y);
        else context.lineTo(x, y);
    }
}

/** Draws the path of the chosen robot. */
export function drawPath(context: CanvasRenderingContext2D, path_mm: ArrayLike<number>, view: Viewport): void {
    context.strokeStyle = themed("--strong");
    context.lineWidth = 2;
    context.lineJoin = "round";
    context.beginPath();
    addLine(context, path_mm, view);
    context.stroke();
}

/**
 * Draws the stored track of the chosen robot. The line of the track is wider than the line of the robot's recent path,
 * which is drawn on top of the track.
 */
export function drawTrack(context: CanvasRenderingContext2D, { strokes_mm }: Track, view: Viewport): void {
    context.strokeStyle = themed("--warn");
    context.lineWidth = 5;
    context.lineJoin = context.lineCap = "round";
    context.beginPath();
    for (const stroke of strokes_mm) {
        addLine(context, stroke, view);
        // A stroke with a single point is drawn as a dot.
        if (stroke.length === 2) context.lineTo(view.x(stroke[0]!), view.y(stroke[1]!));
    }
    context.stroke();
}

/** Draws a ring around the chosen robot. */
export function drawRing(context: CanvasRenderingContext2D, x_mm: number, y_mm: number, view: Viewport): void {
    const kRadius = 14;
    context.beginPath();
    context.arc(view.x(x_mm), view.y(y_mm), kRadius, 0, 2 * Math.PI);
    for (const [width, ink] of [
        [6, "--card"],
        [3, "--strong"],
    ] as const) {
        context.lineWidth = width;
        context.strokeStyle = themed(ink);
        context.stroke();
    }
}

/** Draws a scale bar in the lower left corner. Its length is 1, 2 or 5 times a power of ten. */
export function drawScale(context: CanvasRenderingContext2D, view: Viewport): void {
    const kTarget_px = 110;
    const target_mm = kTarget_px / view.scale;
    const power = 10 ** Math.floor(Math.log10(target_mm));
    const length_mm = power * ([5, 2, 1].find((step) => step * power <= target_mm) ?? 1);
    const [x, y] = [12, view.height - 14];
    context.fillStyle = themed("--text");
    context.fillRect(x, y, length_mm * view.scale, 3);
    context.font = "600 12px system-ui, sans-serif";
    context.textAlign = "left";
    context.textBaseline = "bottom";
    const text = length_mm >= 1e6 ? `${length_mm / 1e6} km` : length_mm >= 1000 ? `${length_mm / 1000} m` : `${length_mm} mm`;
    context.fillText(text, x, y - 3);
}
