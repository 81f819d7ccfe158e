// The position code: symbols in a part of the pattern.
import { coreModule } from "./core.js";
import { Instance, type WasmSource } from "./instance.js";
import { codeNumber, type Cell, type Code, type Section } from "./names.js";

/** A rectangle in the code. */
export interface PatternPart {
    /** Code variant. Default: "anoto". */
    code?: Code;
    /** Section of the code. Default: 0, 0. */
    section?: Section;
    /** Upper left intersection. */
    cell: Cell;
    /** Number of columns of intersections, 1 to 65535. */
    columns: number;
    /** Number of rows of intersections, 1 to 65535. */
    rows: number;
}

/**
 * Displacements of a dot from its intersection, indexed by symbol, in units of the displacement
 * length.
 */
export const kDisplacements: readonly {
    /** Displacement to the right: -1, 0 or 1. */
    dx: number;
    /** Displacement downwards: -1, 0 or 1. */
    dy: number;
}[] = [
    { dx: 0, dy: -1 },
    { dx: -1, dy: 0 },
    { dx: 1, dy: 0 },
    { dx: 0, dy: 1 },
];

/**
 * Returns the symbols in a part of the code, row by row: 0 up, 1 left, 2 right, 3 down. Bit 0 of a
 * symbol is the x bit, and bit 1 is the y bit.
 */
export async function patternBits(part: PatternPart, wasm?: WasmSource): Promise<Uint8Array> {
    const kPlaceBytes = 16;
    const { section = { u: 0, v: 0 }, cell, columns, rows } = part;
    const core = await Instance.start(await coreModule(wasm));
    const place = core.reserve(kPlaceBytes);
    const bytes = Math.max(0, columns * rows);
    const symbols = core.reserve(bytes);
    const view = core.view(place, kPlaceBytes);
    [cell.x, cell.y, section.u, section.v].forEach((value, i) => view.setUint32(4 * i, value, true));
    const status = core.call(
        "dotpose_symbols",
        ...[codeNumber(part.code ?? "anoto"), place, columns, rows, symbols, bytes],
    );
    if (status !== 0) throw new RangeError(core.text(core.call("dotpose_status_message", status)));
    return core.bytes(symbols, bytes).slice();
}
