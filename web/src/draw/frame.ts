// Draws a frame with its dots, grid and pose, layer by layer.
import { imageFromPattern } from "dotpose";
import type { Reading } from "../engine/messages.js";
import { arrow, kInk, kSymbolInk, kSymbolStep, surfaceOf, type Surface } from "./surface.js";

/** The layers to draw. */
export interface Layers {
    /** Opacity of the frame, from 0 to 1. */
    frame?: number;
    /** Draws rings around the detected dots. */
    found?: boolean;
    grid?: boolean;
    /** Draws the symbols of the code in view, as dots of four colours. */
    symbols?: boolean;
    /** Draws arrows from the image centre along the x and y axes of the paper. */
    pose?: boolean;
}

type Pixel = [number, number];

/** Displacement of a dot from its intersection, in spacings. */
const kDisplacement = 1 / 6;

class FrameView {
    readonly scale: number;
    constructor(
        readonly surface: Surface,
        readonly reading: Reading,
    ) {
        this.scale = surface.width / reading.width_px;
    }

    /** Returns the canvas point of an image point. (0, 0) is the centre of the first pixel. */
    at(u_px: number, v_px: number): Pixel {
        return [(u_px + 0.5) * this.scale, (v_px + 0.5) * this.scale];
    }

    /** Returns the canvas point of a pattern point, given in spacings. */
    atCell(x: number, y: number): Pixel {
        const { fix } = this.reading;
        const { u_px, v_px } = imageFromPattern(fix, x * fix.spacing_mm, y * fix.spacing_mm);
        return this.at(u_px, v_px);
    }

    get spacing(): number {
        return this.reading.fix.spacing_px * this.scale;
    }
}

function drawFound(view: FrameView): void {
    const { dots, ok, spacing_px } = view.reading.fix;
    if (dots === null) return;
    const { context } = view.surface;
    const radius = Math.max(2, (ok ? 0.26 * spacing_px : 2.5) * view.scale);
    context.strokeStyle = kInk.found;
    context.lineWidth = Math.max(1, 0.12 * radius);
    context.beginPath();
    for (let i = 0; i + 1 < dots.length; i += 2) {
        const [x, y] = view.at(dots[i]!, dots[i + 1]!);
        context.moveTo(x + radius, y);
        context.arc(x, y, radius, 0, 2 * Math.PI);
    }
    context.stroke();
}

function drawGrid(view: FrameView): void {
    const { cells } = view.reading;
    if (cells === null) return;
    const { context } = view.surface;
    const { first, columns, rows } = cells;
    context.strokeStyle = kInk.grid;
    context.lineWidth = Math.max(0.75, 0.05 * view.spacing);
    context.beginPath();
    for (let i = 0; i < columns; ++i) {
        context.moveTo(...view.atCell(first.x + i, first.y));
        context.lineTo(...view.atCell(first.x + i, first.y + rows - 1));
    }
    for (let j = 0; j < rows; ++j) {
        context.moveTo(...view.atCell(first.x, first.y + j));
        context.lineTo(...view.atCell(first.x + columns - 1, first.y + j));
    }
    context.stroke();
}

function drawSymbols(view: FrameView): void {
    const { cells } = view.reading;
    if (cells === null) return;
    const { context, width, height } = view.surface;
    const { first, columns, symbols } = cells;
    const radius = 0.22 * view.spacing;
    const paths = kSymbolInk.map(() => new Path2D());
    symbols.forEach((symbol, n) => {
        const [dx, dy] = kSymbolStep[symbol]!;
        const i = first.x + (n % columns) + dx * kDisplacement;
        const j = first.y + Math.floor(n / columns) + dy * kDisplacement;
        const [x, y] = view.atCell(i, j);
        if (x < -radius || y < -radius || x > width + radius || y > height + radius) return;
        paths[symbol]!.moveTo(x + radius, y);
        paths[symbol]!.arc(x, y, radius, 0, 2 * Math.PI);
    });
    paths.forEach((path, symbol) => {
        context.fillStyle = kSymbolInk[symbol]!;
        context.fill(path);
    });
}

function drawPose(view: FrameView): void {
    const { fix, width_px, height_px } = view.reading;
    if (!fix.ok) return;
    const { context, width } = view.surface;
    const x = fix.x_mm / fix.spacing_mm;
    const y = fix.y_mm / fix.spacing_mm;
    const centre = view.at((width_px - 1) / 2, (height_px - 1) / 2);
    const reach = Math.max(2.5, (0.12 * width) / view.spacing);
    const line = Math.max(2, width / 220);
    context.lineCap = "round";
    context.lineJoin = "round";
    const axes = [
        [kInk.x, view.atCell(x + reach, y), "x"],
        [kInk.y, view.atCell(x, y + reach), "y"],
    ] as const;
    for (const [ink, end, name] of axes) {
        for (const [style, thick] of [[kInk.halo, line + 2.5], [ink, line]] as const) {
            context.strokeStyle = style;
            context.lineWidth = thick;
            arrow(context, centre, end, 4 * line);
        }
        context.font = `700 ${Math.max(13, 5.5 * line)}px system-ui, sans-serif`;
        context.textAlign = "center";
        context.textBaseline = "middle";
        const out = (k: 0 | 1) => end[k] + (5 * line * (end[k] - centre[k])) / Math.hypot(end[0] - centre[0], end[1] - centre[1]);
        context.lineWidth = 4;
        context.strokeStyle = kInk.halo;
        context.strokeText(name, out(0), out(1));
        context.fillStyle = "#fff";
        context.fillText(name, out(0), out(1));
    }
    context.beginPath();
    context.arc(...centre, 2 * line, 0, 2 * Math.PI);
    context.fillStyle = "#fff";
    context.fill();
    context.lineWidth = line;
    context.strokeStyle = kInk.halo;
    context.stroke();
}

/** Draws a reading. Sets the aspect ratio of the canvas to the aspect ratio of the frame. */
export function drawFrame(canvas: HTMLCanvasElement, reading: Reading, layers: Layers): void {
    const surface = surfaceOf(canvas, reading.width_px / reading.height_px);
    const view = new FrameView(surface, reading);
    const { context, width, height } = surface;
    context.imageSmoothingEnabled = view.scale < 1;
    context.globalAlpha = layers.frame ?? 1;
    context.drawImage(reading.picture, 0, 0, width, height);
    context.globalAlpha = 1;
    if (layers.grid) drawGrid(view);
    if (layers.symbols) drawSymbols(view);
    if (layers.found) drawFound(view);
    if (layers.pose) drawPose(view);
}
