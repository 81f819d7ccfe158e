// Computes the camera's field of view on the paper.
import { patternFromImage, type Fix } from "dotpose";
import { pageFromPattern, type Point_mm } from "../page/sheet_frame.js";
import type { SheetLayout } from "./messages.js";

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
 * Converts points from pattern coordinates to page coordinates. Returns them unchanged if the sheet
 * is unknown.
 */
export function onPage(sheet: SheetLayout | null, points: readonly Point_mm[]): Point_mm[] {
    return points.map((point) => (sheet ? pageFromPattern(sheet, point) : point));
}
