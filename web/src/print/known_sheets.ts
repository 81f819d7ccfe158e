// Sheets that were printed from this page. They are stored in the browser.
import type { SheetLayout } from "../engine/messages.js";

export interface KnownSheet {
    name: string;
    layout: SheetLayout;
}

const kKey = "dotpose-sheets";

function isSheet(value: unknown): value is KnownSheet {
    const { name, layout } = (value ?? {}) as Partial<KnownSheet>;
    const numbers = [layout?.origin?.x, layout?.origin?.y, layout?.width_mm, layout?.first_x_mm, layout?.columns];
    return typeof name === "string" && numbers.every((number) => Number.isFinite(number));
}

/** Returns the stored sheets. Skips invalid entries. */
export function knownSheets(): KnownSheet[] {
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
    } catch {
        // Storage is not allowed. The sheet can still be printed.
    }
}

/** Stores a sheet. Replaces a sheet with the same name. */
export function remember(sheet: KnownSheet): void {
    keep([...knownSheets().filter(({ name }) => name !== sheet.name), sheet]);
}

export function forget(forgotten: string): void {
    keep(knownSheets().filter(({ name }) => name !== forgotten));
}

/** Returns the origin of a region that is not used by any known sheet. */
export function freshOrigin(): { x: number; y: number } {
    const right = knownSheets().map(({ layout }) => layout.origin.x + layout.columns);
    return { x: Math.max(1000, ...right), y: 2000 };
}
