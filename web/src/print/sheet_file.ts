// Reads sheet files, which the command-line tool writes (docs/sheet-files.md).
import { kCodes, type Code } from "dotpose";
import { kPositions, kSpacing_mm } from "../page/sheet_frame.js";
import type { KnownSheet } from "./known_sheets.js";

const kLastSection = 62;
/** Minimum number of columns and rows of a sheet. */
const kMinCells = 8;

type Entry = Record<string, unknown>;

/** The members of one sheet in the file. `path` locates the sheet in the file, for error messages. */
class Members {
    constructor(
        private readonly entry: Entry,
        private readonly path: string,
    ) {}

    text(key: string): string {
        const value = this.entry[key];
        return typeof value === "string" ? value : this.refuse(key, "must be a string");
    }
    number(key: string): number {
        const value = this.entry[key];
        return typeof value === "number" ? value : this.refuse(key, "must be a number");
    }
    length_mm(key: string): number {
        const value = this.number(key);
        return value > 0 ? value : this.refuse(key, "must be above 0");
    }
    whole(key: string, min: number, max: number): number {
        const value = this.number(key);
        if (Number.isInteger(value) && value >= min && value <= max) return value;
        return this.refuse(key, `is ${value}; it must be a whole number from ${min} to ${max}`);
    }
    refuse(key: string, problem: string): never {
        throw new Error(`${this.path}.${key} ${problem}`);
    }
}

function sheetOf(entry: unknown, i: number): KnownSheet {
    const path = `sheets[${i}]`;
    if (typeof entry !== "object" || entry === null) throw new Error(`${path} must be an object`);
    const members = new Members(entry as Entry, path);
    const code = members.text("code") as Code;
    if (!kCodes.includes(code)) members.refuse("code", `is '${code}'; it must be ${kCodes.join(", ")}`);
    const spacing_mm = members.number("spacing_mm");
    if (spacing_mm !== kSpacing_mm)
        members.refuse("spacing_mm", `is ${spacing_mm}; this page locates sheets with a spacing of ${kSpacing_mm} mm`);
    const origin = { x: members.whole("origin_x", 0, kPositions - 1), y: members.whole("origin_y", 0, kPositions - 1) };
    return {
        name: members.text("name"),
        layout: {
            code,
            section: { u: members.whole("section_u", 0, kLastSection), v: members.whole("section_v", 0, kLastSection) },
            origin,
            columns: members.whole("columns", kMinCells, kPositions - origin.x),
            rows: members.whole("rows", kMinCells, kPositions - origin.y),
            width_mm: members.length_mm("width_mm"),
            height_mm: members.length_mm("height_mm"),
            first_x_mm: members.number("first_x_mm"),
            first_y_mm: members.number("first_y_mm"),
        },
    };
}

/**
 * Returns the sheets in a sheet file. If a key is not valid, throws an Error that names the key. Ignores the print
 * scale and the world pose of each page.
 */
export function sheetsOfFile(text: string): KnownSheet[] {
    let document: unknown;
    try {
        document = JSON.parse(text);
    } catch {
        throw new Error("it is not JSON");
    }
    const { format, version, sheets } = (document ?? {}) as Entry;
    if (format !== "dotpose-sheets") throw new Error('its "format" is not "dotpose-sheets"');
    if (version !== 1) throw new Error(`its version is ${String(version)}; this page reads version 1`);
    if (!Array.isArray(sheets)) throw new Error("sheets must be an array");
    return sheets.map(sheetOf);
}
