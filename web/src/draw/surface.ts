// Sets up canvases that use CSS pixels as coordinates and have the resolution of the screen.

/**
 * Colours for drawing over camera frames. They are distinguishable with all types of colour vision.
 */
export const kInk = {
    up: "#0072b2",
    left: "#d55e00",
    right: "#009e73",
    down: "#cc79a7",
    found: "#ffb000",
    grid: "rgba(120, 190, 255, 0.55)",
    x: "#e4572e",
    y: "#1f9d6b",
    halo: "rgba(0, 0, 0, 0.65)",
};

/** Colours of the symbols: 0 up, 1 left, 2 right, 3 down. */
export const kSymbolInk = [kInk.up, kInk.left, kInk.right, kInk.down] as const;
export const kSymbolStep = [
    [0, -1],
    [-1, 0],
    [1, 0],
    [0, 1],
] as const;

export interface Surface {
    context: CanvasRenderingContext2D;
    width: number;
    height: number;
}

/**
 * Sets the resolution of the canvas to the resolution of the screen, and clears the canvas. If `aspect` (width divided
 * by height) is given, also sets the aspect ratio of the canvas, and passes it to the style sheet as `--aspect`.
 */
export function surfaceOf(canvas: HTMLCanvasElement, aspect?: number): Surface {
    if (aspect !== undefined) {
        canvas.style.aspectRatio = String(aspect);
        canvas.style.setProperty("--aspect", String(aspect));
    }
    const scale = window.devicePixelRatio || 1;
    const width = canvas.clientWidth;
    const height = canvas.clientHeight;
    const [columns, rows] = [Math.round(width * scale), Math.round(height * scale)];
    if (canvas.width !== columns || canvas.height !== rows) Object.assign(canvas, { width: columns, height: rows });
    const context = canvas.getContext("2d")!;
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, width, height);
    return { context, width, height };
}

/**
 * Cache of the colours in the style sheet, by name, for the light and the dark scheme. Without the cache, drawing would
 * be slow, because reading a colour from the style sheet takes as long as drawing a shape.
 */
const colours = [new Map<string, string>(), new Map<string, string>()] as const;
let dark: MediaQueryList | undefined;

/** Returns a colour from the style sheet, for the current colour scheme. */
export function themed(name: string): string {
    dark ??= window.matchMedia("(prefers-color-scheme: dark)");
    const known = colours[dark.matches ? 1 : 0];
    let colour = known.get(name);
    if (colour === undefined) {
        colour = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
        known.set(name, colour);
    }
    return colour;
}

/** Draws an arrow. */
export function arrow(
    context: CanvasRenderingContext2D,
    from: readonly [number, number],
    to: readonly [number, number],
    head: number,
): void {
    const angle = Math.atan2(to[1] - from[1], to[0] - from[0]);
    context.beginPath();
    context.moveTo(...from);
    context.lineTo(...to);
    for (const side of [-1, 1]) {
        context.moveTo(...to);
        context.lineTo(to[0] - head * Math.cos(angle + side * 0.5), to[1] - head * Math.sin(angle + side * 0.5));
    }
    context.stroke();
}
