// Known sheets: those that were printed from this page, and those of the sheet files that were opened.
// They are stored in the browser.
import type { Fix, KnownRegion } from "dotpose";
import type { SheetLayout } from "../engine/messages.js";
import { isOnSheet } from "../page/sheet_frame.js";

export interface KnownSheet {
    name: string;
    layout: SheetLayout;
}

const kKey = "dotpose-sheets";
/** The list, if the browser does not allow storage. */
let unstored: KnownSheet[] = [];

function isSheet(value: unknown): value is KnownSheet {
    const { name, layout } = (value ?? {}) as Partial<KnownSheet>;
    const whole = [layout?.section?.u, layout?.section?.v, layout?.origin?.x, layout?.origin?.y, layout?.columns, layout?.rows];
    const lengths_mm = [layout?.width_mm, layout?.height_mm, layout?.first_x_mm, layout?.first_y_mm];
    const isCount = (number: unknown) => Number.isInteger(number) && (number as number) >= 0;
    return typeof name === "string" && whole.every(isCount) && lengths_mm.every((length) => Number.isFinite(length));
}

/** Returns the stored sheets. Skips invalid entries. */
export function knownSheets(): KnownSheet[] {
    try {
        const kept: unknown = JSON.parse(localStorage.getItem(kKey) ?? "[]");
        return [...(Array.isArray(kept) ? kept.filter(isSheet) : []), ...unstored];
    } catch {
        return unstored;
    }
}

function keep(sheets: KnownSheet[]): void {
    try {
        localStorage.setItem(kKey, JSON.stringify(sheets));
        unstored = [];
    } catch {
        unstored = sheets;
    }
}

/** Stores sheets. They replace sheets with the same names. */
export function remember(sheets: readonly KnownSheet[]): void {
    const names = new Set(sheets.map(({ name }) => name));
    keep([...knownSheets().filter(({ name }) => !names.has(name)), ...sheets]);
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

/** Returns the sheet on which a fix is, or null if it is on none of them. */
export function sheetUnder(fix: Fix, sheets: readonly KnownSheet[]): KnownSheet | null {
    return (fix.ok && sheets.find(({ layout }) => isOnSheet(layout, fix))) || null;
}
