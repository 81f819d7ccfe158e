// Draws robots on a map. Conditions differ in shape and colour.
import { themed } from "../draw/surface.js";
import { kConditions, kHasHeading, kIsUnknown, type Condition, type Positions, type Trails } from "./messages.js";
import type { Viewport } from "./viewport.js";

/** Names of the colours in the style sheet. */
const kInk: Record<Condition, string> = {
    moving: "--accent",
    still: "--good",
    lost: "--lost",
    silent: "--silent",
    gone: "--soft",
};
/** Symbols of the conditions in texts. */
export const kSymbols: Record<Condition, string> = { moving: "▲", still: "●", lost: "○", silent: "✕", gone: "·" };

/** Returns the radius of a mark. It decreases with the number of robots in view. */
function radiusFor(count: number): number {
    return count > 500 ? 3.5 : count > 100 ? 5 : 7;
}

type Place = [x: number, y: number, angle: number | null];

function addMark(context: CanvasRenderingContext2D, condition: Condition, [x, y, angle]: Place, r: number): void {
    if (condition === "silent") {
        context.moveTo(x - r, y - r);
        context.lineTo(x + r, y + r);
        context.moveTo(x - r, y + r);
        context.lineTo(x + r, y - r);
    } else if (condition === "moving" && angle !== null) {
        const [cos, sin] = [r * Math.cos(angle), r * Math.sin(angle)];
        // Chromium's closePath takes time proportional to the length of the path.
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

/** Draws all robots, those that need attention last, so that they are on top. */
export function drawRobots(context: CanvasRenderingContext2D, positions: Positions, view: Viewport): void {
    const r = radiusFor(positions.count);
    const sign = view.y_up ? -1 : 1;
    const place = (i: number): Place => [
        view.x(positions.at_mm[2 * i]!),
        view.y(positions.at_mm[2 * i + 1]!),
        positions.flags[i]! & kHasHeading ? sign * positions.headings_rad[i]! : null,
    ];
    for (const condition of ["gone", "still", "moving", "lost", "silent"] as const) {
        const index = kConditions.indexOf(condition);
        context.beginPath();
        for (let i = 0; i < positions.count; ++i)
            if (positions.conditions[i] === index) addMark(context, condition, place(i), r);
        const is_outline = condition === "lost" || condition === "silent";
        context.lineWidth = is_outline ? 2.5 : 1;
        context.fillStyle = themed(kInk[condition]);
        context.strokeStyle = is_outline ? context.fillStyle : themed("--paper");
        if (!is_outline) context.fill();
        context.stroke();
    }
    drawUnknown(context, positions, place, r);
}

/** Draws a square around each robot on a sheet that the sheet file does not contain. */
function drawUnknown(context: CanvasRenderingContext2D, positions: Positions, place: (i: number) => Place, r: number): void {
    context.strokeStyle = themed("--warn");
    context.lineWidth = 1.5;
    context.beginPath();
    for (let i = 0; i < positions.count; ++i) {
        if (!(positions.flags[i]! & kIsUnknown)) continue;
        const [x, y] = place(i);
        context.rect(x - 1.8 * r, y - 1.8 * r, 3.6 * r, 3.6 * r);
    }
    context.stroke();
}

/** Draws the names. Draws none if there is too little room for them. */
export function drawNames(context: CanvasRenderingContext2D, { names, at_mm, count }: Positions, view: Viewport): void {
    const kArea_px = 6000;
    if (names === undefined || count * kArea_px > view.width * view.height) return;
    context.font = "600 12px system-ui, sans-serif";
    context.textAlign = "left";
    context.textBaseline = "middle";
    context.lineWidth = 3;
    context.lineJoin = "round";
    context.strokeStyle = themed("--card");
    context.fillStyle = themed("--text");
    for (let i = 0; i < count; ++i) {
        const [x, y] = [view.x(at_mm[2 * i]!) + 12, view.y(at_mm[2 * i + 1]!) - 10];
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

/** Draws the connection between the end of each trail and the robot, which is newer. */
export function drawTrailEnds(context: CanvasRenderingContext2D, trails: Trails, positions: Positions, view: Viewport): void {
    context.strokeStyle = themed("--accent");
    context.globalAlpha = 0.35;
    context.lineWidth = trails.trails_mm.size > 500 ? 1 : 2;
    context.beginPath();
    for (let i = 0; i < positions.count; ++i) {
        const trail = trails.trails_mm.get(positions.ids[i]!);
        if (trail === undefined || trail.length === 0) continue;
        context.moveTo(view.x(trail.at(-2)!), view.y(trail.at(-1)!));
        context.lineTo(view.x(positions.at_mm[2 * i]!), view.y(positions.at_mm[2 * i + 1]!));
    }
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

/** Draws a bar of a round length in the lower left corner. */
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
