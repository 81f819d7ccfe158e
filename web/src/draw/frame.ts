// Draws a frame with its dots, grid and pose, layer by layer.
import { arrow, kInk, kSymbolInk, surfaceOf, type Surface } from "./surface.js";

/** The layers to draw. */
export interface Layers {
    /** Opacity of the frame, from 0 to 1. */
    frame?: number;
    /** Draws rings around the detected dots. */
    found?: boolean;
    grid?: boolean;
    /** Draws the symbols of the code in view, as dots in four colours. */
    symbols?: boolean;
    /** Draws arrows from the reference point along the x and y axes of the paper. */
    pose?: boolean;
}

export type Pixel = readonly [number, number];

/** The axes of the paper, as they appear in a frame. */
export interface Axes {
    /** The reference point of the pose. */
    at: Pixel;
    /** Unit vectors along the axes. */
    x: Pixel;
    y: Pixel;
}

/** Shapes drawn over a frame, in px from the upper left corner of the frame. */
export interface FrameOverlay {
    /** Centres of the detected dots, as alternating u and v. */
    dots: ArrayLike<number>;
    /** Lines of the grid. Each line is a list of points, as alternating u and v. */
    grid: readonly ArrayLike<number>[];
    /** Spacing of the grid, or 0 if there is no grid. */
    spacing_px: number;
    /** Symbols of the code in view, with the predicted centres of their dots. */
    symbols: readonly { at: Pixel; symbol: number }[];
    /** Axes of the paper. Null if there is no pose. */
    axes: Axes | null;
}

export interface DrawnFrame {
    picture: CanvasImageSource;
    /** Size of the frame. The picture may have a different resolution. */
    width_px: number;
    height_px: number;
    overlay: FrameOverlay;
}

class FrameView {
    readonly scale: number;
    constructor(
        readonly surface: Surface,
        readonly frame: DrawnFrame,
    ) {
        this.scale = surface.width / frame.width_px;
    }

    get overlay(): FrameOverlay {
        return this.frame.overlay;
    }

    get spacing(): number {
        return this.overlay.spacing_px * this.scale;
    }

    at([u_px, v_px]: Pixel): [number, number] {
        return [u_px * this.scale, v_px * this.scale];
    }
}

function drawFound(view: FrameView): void {
    const { dots, spacing_px } = view.overlay;
    const { context } = view.surface;
    const radius = Math.max(2, (spacing_px > 0 ? 0.26 * spacing_px : 2.5) * view.scale);
    context.strokeStyle = kInk.found;
    context.lineWidth = Math.max(1, 0.12 * radius);
    context.beginPath();
    for (let i = 0; i + 1 < dots.length; i += 2) {
        const [x, y] = view.at([dots[i]!, dots[i + 1]!]);
        context.moveTo(x + radius, y);
        context.arc(x, y, radius, 0, 2 * Math.PI);
    }
    context.stroke();
}

function drawGrid(view: FrameView): void {
    const { context } = view.surface;
    context.strokeStyle = kInk.grid;
    context.lineWidth = Math.max(0.75, 0.05 * view.spacing);
    context.beginPath();
    for (const line of view.overlay.grid)
        for (let i = 0; i + 1 < line.length; i += 2) {
            const point = view.at([line[i]!, line[i + 1]!]);
            if (i === 0) context.moveTo(...point);
            else context.lineTo(...point);
        }
    context.stroke();
}

function drawSymbols(view: FrameView): void {
    const { context, width, height } = view.surface;
    const radius = 0.22 * view.spacing;
    const paths = kSymbolInk.map(() => new Path2D());
    for (const { at, symbol } of view.overlay.symbols) {
        const [x, y] = view.at(at);
        if (x < -radius || y < -radius || x > width + radius || y > height + radius) continue;
        paths[symbol]!.moveTo(x + radius, y);
        paths[symbol]!.arc(x, y, radius, 0, 2 * Math.PI);
    }
    paths.forEach((path, symbol) => {
        context.fillStyle = kSymbolInk[symbol]!;
        context.fill(path);
    });
}

function drawPose(view: FrameView): void {
    const { axes } = view.overlay;
    if (axes === null) return;
    const { context, width } = view.surface;
    const centre = view.at(axes.at);
    const reach = Math.max(2.5 * view.spacing, 0.12 * width);
    const line = Math.max(2, width / 220);
    context.lineCap = "round";
    context.lineJoin = "round";
    for (const [ink, [du, dv], name] of [
        [kInk.x, axes.x, "x"],
        [kInk.y, axes.y, "y"],
    ] as const) {
        const along = (distance: number): [number, number] => [centre[0] + distance * du, centre[1] + distance * dv];
        for (const [style, thick] of [[kInk.halo, line + 2.5], [ink, line]] as const) {
            context.strokeStyle = style;
            context.lineWidth = thick;
            arrow(context, centre, along(reach), 4 * line);
        }
        context.font = `700 ${Math.max(13, 5.5 * line)}px system-ui, sans-serif`;
        context.textAlign = "center";
        context.textBaseline = "middle";
        const label = along(reach + 5 * line);
        context.lineWidth = 4;
        context.strokeStyle = kInk.halo;
        context.strokeText(name, ...label);
        context.fillStyle = "#fff";
        context.fillText(name, ...label);
    }
    context.beginPath();
    context.arc(...centre, 2 * line, 0, 2 * Math.PI);
    context.fillStyle = "#fff";
    context.fill();
    context.lineWidth = line;
    context.strokeStyle = kInk.halo;
    context.stroke();
}

/** Draws a frame. Gives the canvas the aspect ratio of the frame. */
export function drawFrame(canvas: HTMLCanvasElement, frame: DrawnFrame, layers: Layers): void {
    const surface = surfaceOf(canvas, frame.width_px / frame.height_px);
    const view = new FrameView(surface, frame);
    const { context, width, height } = surface;
    context.imageSmoothingEnabled = view.scale < 1;
    context.globalAlpha = layers.frame ?? 1;
    context.drawImage(frame.picture, 0, 0, width, height);
    context.globalAlpha = 1;
    if (layers.grid) drawGrid(view);
    if (layers.symbols) drawSymbols(view);
    if (layers.found) drawFound(view);
    if (layers.pose) drawPose(view);
}
