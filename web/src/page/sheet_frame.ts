// Converts between coordinates on a page, in mm from its upper left corner, and coordinates in its
// pattern.
import type { SheetLayout } from "../engine/messages.js";

/** Number of columns in each section of the code. The number of rows is the same. */
export const kPositions = 410_815_348;

/** Spacing of the sheets that this web page prints and simulates. */
export const kSpacing_mm = 0.508;

export interface Point_mm {
    x_mm: number;
    y_mm: number;
}

/** Returns the pattern point that is printed at a point on the page. */
export function patternFromPage(sheet: SheetLayout, { x_mm, y_mm }: Point_mm): Point_mm {
    return {
        x_mm: sheet.origin.x * kSpacing_mm + x_mm - sheet.first_x_mm,
        y_mm: sheet.origin.y * kSpacing_mm + y_mm - sheet.first_y_mm,
    };
}

/** Returns the point on the page at which a pattern point is printed. */
export function pageFromPattern(sheet: SheetLayout, { x_mm, y_mm }: Point_mm): Point_mm {
    return {
        x_mm: x_mm - sheet.origin.x * kSpacing_mm + sheet.first_x_mm,
        y_mm: y_mm - sheet.origin.y * kSpacing_mm + sheet.first_y_mm,
    };
}

/** Returns true if `at`, a pattern point with its code and section, is on the page of the sheet. */
export function isOnSheet(
    sheet: SheetLayout,
    at: Point_mm & { code: string; section: { u: number; v: number } },
): boolean {
    const { x_mm, y_mm } = pageFromPattern(sheet, at);
    const isThis = sheet.code === at.code && sheet.section.u === at.section.u && sheet.section.v === at.section.v;
    return isThis && x_mm >= 0 && y_mm >= 0 && x_mm <= sheet.width_mm && y_mm <= sheet.height_mm;
}
