// Computes the overlay of a reading: its dots, grid, symbols and axes in the frame.
import { imageFromPattern } from "dotpose";
import type { Axes, DrawnFrame, FrameOverlay, Pixel } from "../draw/frame.js";
import { kSymbolStep } from "../draw/surface.js";
import type { CellsInView, Reading } from "./messages.js";

/** Displacement of a dot from its intersection, in spacings. */
const kDisplacement = 1 / 6;

/**
 * Converts the pattern point (x, y), in spacings, to a point in the frame, in px from its upper left corner. In image
 * coordinates, (0, 0) is the centre of the first pixel, which is at (0.5, 0.5) in the frame.
 */
function pixelOf({ fix }: Reading, x: number, y: number): Pixel {
    const { u_px, v_px } = imageFromPattern(fix, x * fix.spacing_mm, y * fix.spacing_mm);
    return [u_px + 0.5, v_px + 0.5];
}

function gridOf(reading: Reading, { first, columns, rows }: CellsInView): number[][] {
    const lines: number[][] = [];
    const [right, bottom] = [first.x + columns - 1, first.y + rows - 1];
    for (let x = first.x; x <= right; ++x) lines.push([...pixelOf(reading, x, first.y), ...pixelOf(reading, x, bottom)]);
    for (let y = first.y; y <= bottom; ++y) lines.push([...pixelOf(reading, first.x, y), ...pixelOf(reading, right, y)]);
    return lines;
}

function symbolsOf(reading: Reading, { first, columns, symbols }: CellsInView): FrameOverlay["symbols"] {
    return Array.from(symbols, (symbol, n) => {
        const [dx, dy] = kSymbolStep[symbol]!;
        const x = first.x + (n % columns) + dx * kDisplacement;
        const y = first.y + Math.floor(n / columns) + dy * kDisplacement;
        return { at: pixelOf(reading, x, y), symbol };
    });
}

function axesOf(reading: Reading): Axes {
    const { fix, width_px, height_px } = reading;
    const [x, y] = [fix.x_mm / fix.spacing_mm, fix.y_mm / fix.spacing_mm];
    const at: Pixel = [width_px / 2, height_px / 2];
    const towards = ([u, v]: Pixel): Pixel => {
        const length = Math.hypot(u - at[0], v - at[1]);
        return [(u - at[0]) / length, (v - at[1]) / length];
    };
    return { at, x: towards(pixelOf(reading, x + 1, y)), y: towards(pixelOf(reading, x, y + 1)) };
}

/** Returns the frame of a reading, together with the overlay. */
export function drawnFrame(reading: Reading): DrawnFrame {
    const { fix, cells, picture, width_px, height_px } = reading;
    return {
        picture,
        width_px,
        height_px,
        overlay: {
            dots: (fix.dots ?? []).map((coordinate) => coordinate + 0.5),
            grid: cells ? gridOf(reading, cells) : [],
            spacing_px: fix.ok ? fix.spacing_px : 0,
            symbols: cells ? symbolsOf(reading, cells) : [],
            axes: fix.ok ? axesOf(reading) : null,
        },
    };
}
