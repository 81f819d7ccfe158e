// Finds the symbols of the code in view. A block of symbols around the view is cached, so small camera motions do not
// require new symbols.
import { patternBits, patternFromImage, type Cell, type Code, type Fix } from "dotpose";
import { kPositions } from "../page/sheet_frame.js";
import type { CellsInView } from "./messages.js";

const kAround = 64;
const kMaxCells = 20_000;

interface Block extends CellsInView {
    key: string;
}
let block: Block | undefined;

interface Range {
    first: Cell;
    columns: number;
    rows: number;
}

/** Returns the cells that are visible in the frame of a fix, or null if there are too many cells to draw. */
function rangeInView(fix: Fix, width: number, height: number): Range | null {
    const corners = [0, width - 1].flatMap((u) =>
        [0, height - 1].map((v) => patternFromImage(fix, u, v)),
    );
    const xs = corners.map((corner) => corner.x_mm / fix.spacing_mm);
    const ys = corners.map((corner) => corner.y_mm / fix.spacing_mm);
    const clamp = (cell: number) => Math.min(Math.max(cell, 0), kPositions - 1);
    const first = { x: clamp(Math.floor(Math.min(...xs))), y: clamp(Math.floor(Math.min(...ys))) };
    const columns = clamp(Math.ceil(Math.max(...xs))) - first.x + 1;
    const rows = clamp(Math.ceil(Math.max(...ys))) - first.y + 1;
    return columns * rows <= kMaxCells ? { first, columns, rows } : null;
}

function holds(kept: Block, range: Range): boolean {
    const right = range.first.x + range.columns <= kept.first.x + kept.columns;
    const bottom = range.first.y + range.rows <= kept.first.y + kept.rows;
    return range.first.x >= kept.first.x && range.first.y >= kept.first.y && right && bottom;
}

async function fetchBlock(range: Range, code: Code, fix: Fix, key: string): Promise<Block> {
    const first = { x: Math.max(0, range.first.x - kAround), y: Math.max(0, range.first.y - kAround) };
    const columns = Math.min(range.first.x + range.columns + kAround, kPositions) - first.x;
    const rows = Math.min(range.first.y + range.rows + kAround, kPositions) - first.y;
    const symbols = await patternBits({ code, section: fix.section, cell: first, columns, rows });
    return { key, first, columns, rows, symbols };
}

/** Returns the code symbols that are visible in the frame of a fix, or null if there are none to draw. */
export async function cellsInView(fix: Fix, width: number, height: number): Promise<CellsInView | null> {
    if (!fix.ok || !(fix.spacing_mm > 0)) return null;
    const range = rangeInView(fix, width, height);
    if (range === null) return null;
    const key = `${fix.code} ${fix.section.u} ${fix.section.v}`;
    if (block?.key !== key || !holds(block, range)) block = await fetchBlock(range, fix.code, fix, key);
    const symbols = new Uint8Array(range.columns * range.rows);
    for (let j = 0; j < range.rows; ++j) {
        const from = (range.first.y - block.first.y + j) * block.columns + range.first.x - block.first.x;
        symbols.set(block.symbols.subarray(from, from + range.columns), j * range.columns);
    }
    return { ...range, symbols };
}
