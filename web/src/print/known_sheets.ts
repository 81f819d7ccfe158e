// Known sheets: sheets that were printed from this web page, and the sheets in opened sheet files. They are stored in
// the browser.
import { kCodes, type Fix, type KnownRegion } from "dotpose";
import type { SheetLayout } from "../engine/messages.js";
import { isOnSheet, kPositions } from "../page/sheet_frame.js";

export interface KnownSheet {
    name: string;
    layout: SheetLayout;
}

const kKey = "dotpose-sheets";
/** The list of sheets if the browser does not allow storage. Null if the list is in the browser's storage. */
let unstored: KnownSheet[] | null = null;

/** Returns true for an integer from `min` to `max`. */
function isWhole(value: unknown, min: number, max: number): boolean {
    return Number.isInteger(value) && (value as number) >= min && (value as number) <= max;
}

function isSheet(value: unknown): value is KnownSheet {
    const { name, layout } = (value ?? {}) as Partial<KnownSheet>;
    if (typeof name !== "string" || !layout?.section || !layout.origin) return false;
    const { code, section, origin, columns, rows, width_mm, height_mm, first_x_mm, first_y_mm } = layout;
    return (
        kCodes.includes(code) &&
        [section.u, section.v].every((roll) => isWhole(roll, 0, 62)) &&
        [origin.x, origin.y].every((cell) => isWhole(cell, 0, kPositions - 1)) &&
        isWhole(columns, 1, kPositions - origin.x) &&
        isWhole(rows, 1, kPositions - origin.y) &&
        [width_mm, height_mm, first_x_mm, first_y_mm].every((length) => Number.isFinite(length))
    );
}

/** Returns the stored sheets. Skips invalid entries. */
export function knownSheets(): KnownSheet[] {
    if (unstored !== null) return unstored;
    try {
        const kept: unknown = JSON.parse(localStorage.getItem(kKey) ?? "[]");
        return Array.isArray(kept) ? kept.filter(isSheet) : [];
    } catch {
        return [];
    }
}

function keep(sheets: KnownSheet[]): void {
    try {
        localStorage.setItem(kKey, JSON.stringify(sheets));
        unstored = null;
    } catch {
        unstored = sheets;
    }
}

/** Stores a sheet. Replaces a sheet with the same name. */
export function remember(sheet: KnownSheet): void {
    keep([...knownSheets().filter(({ name }) => name !== sheet.name), sheet]);
}

/**
 * Stores the sheets from a file, replacing known sheets that use the same parts of the code. If a sheet from the file
 * has the name of a remaining known sheet, or of an earlier sheet from the file, a number is appended to its name.
 */
export function rememberAll(sheets: readonly KnownSheet[]): void {
    const partOf = ({ layout }: KnownSheet) => JSON.stringify(regionOf(layout));
    const parts = new Set(sheets.map(partOf));
    const known = knownSheets().filter((sheet) => !parts.has(partOf(sheet)));
    const names = new Set(known.map(({ name }) => name));
    for (const sheet of sheets) {
        let { name } = sheet;
        for (let number = 2; names.has(name); ++number) name = `${sheet.name} ${number}`;
        names.add(name);
        known.push({ ...sheet, name });
    }
    keep(known);
}

export function forget(forgotten: string): void {
    keep(knownSheets().filter(({ name }) => name !== forgotten));
}

/** Returns the origin of a region that is not used by any known sheet. */
export function freshOrigin(): { x: number; y: number } {
    const right = knownSheets().map(({ layout }) => layout.origin.x + layout.columns);
    return { x: Math.max(1000, ...right), y: 2000 };
}

/** Returns the part of the code that is printed on a sheet. */
export function regionOf({ code, section, origin, columns, rows }: SheetLayout): KnownRegion {
    return { code, section, first: origin, columns, rows };
}

/** Returns the sheet that contains a fix, or null if there is none. */
export function sheetUnder(fix: Fix, sheets: readonly KnownSheet[]): KnownSheet | null {
    if (!fix.ok) return null;
    return sheets.find(({ layout }) => isOnSheet(layout, fix)) ?? null;
}
