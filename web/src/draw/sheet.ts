// Draws the sheet to be printed: the whole page, and an enlarged corner.
import type { SheetLayout } from "../engine/messages.js";
import { kSpacing_mm } from "../page/sheet_frame.js";
import { kSymbolInk, kSymbolStep, surfaceOf, themed } from "./surface.js";

/** Draws the page with its field of dots, in the correct proportions. */
export function drawPage(canvas: HTMLCanvasElement, sheet: SheetLayout): void {
    const { context, width, height } = surfaceOf(canvas);
    const kMargin = 14;
    const scale = Math.min((width - 2 * kMargin) / sheet.width_mm, (height - 2 * kMargin) / sheet.height_mm);
    const [left, top] = [(width - scale * sheet.width_mm) / 2, (height - scale * sheet.height_mm) / 2];
    context.save();
    context.shadowColor = "rgba(0, 0, 0, 0.25)";
    context.shadowBlur = 12;
    context.shadowOffsetY = 3;
    context.fillStyle = "#ffffff";
    context.fillRect(left, top, scale * sheet.width_mm, scale * sheet.height_mm);
    context.restore();
    const [x, y] = [left + scale * sheet.first_x_mm, top + scale * sheet.first_y_mm];
    const [columns_px, rows_px] = [scale * sheet.columns * kSpacing_mm, scale * sheet.rows * kSpacing_mm];
    context.fillStyle = "#dfe3e8";
    context.fillRect(x, y, columns_px, rows_px);
    context.fillStyle = "#4a5058";
    context.font = "600 13px system-ui, sans-serif";
    context.textAlign = "center";
    context.fillText(`${sheet.width_mm} x ${sheet.height_mm} mm`, left + (scale * sheet.width_mm) / 2, y + rows_px / 2);
}

/** Draws the first cells of the sheet with the dots at their printed positions. */
export function drawCorner(canvas: HTMLCanvasElement, sheet: SheetLayout, symbols: Uint8Array, cells: number): void {
    const { context, width, height } = surfaceOf(canvas);
    context.fillStyle = themed("--paper");
    context.fillRect(0, 0, width, height);
    const columns = Math.min(cells, sheet.columns);
    const step = width / columns;
    symbols.forEach((symbol, n) => {
        const [dx, dy] = kSymbolStep[symbol]!;
        const x = ((n % columns) + 0.5 + dx / 6) * step;
        const y = (Math.floor(n / columns) + 0.5 + dy / 6) * step;
        if (y - step > height) return;
        context.fillStyle = kSymbolInk[symbol]!;
        context.beginPath();
        context.arc(x, y, step / 7, 0, 2 * Math.PI);
        context.fill();
    });
}
