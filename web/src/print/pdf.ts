// Makes the PDF of a sheet. The dots are the same as those of `dotpose print` at 600 dpi. They are printed with black
// ink only.
//
// Dots are drawn with a font of four glyphs. At the default spacing, dots consist of whole printer
// pixels at 300, 600 and 1200 dpi, and renderers place glyphs on whole pixels.
// src/print/pdf_dots.cpp explains the constants.
import { PDFDocument, PDFName, type PDFContext, type PDFRef } from "@cantoo/pdf-lib";
import { kSymbolStep } from "../draw/surface.js";
import type { SheetLayout } from "../engine/messages.js";
import { kSpacing_mm } from "../page/sheet_frame.js";
import { labelContent } from "./pdf_labels.js";
import { kPointsPerMm } from "./pdf_text.js";

const kDpi = 600;
const kDot_mm = kSpacing_mm / 6;
const kDisplacement_mm = kSpacing_mm / 6;
const kUnitsPerEm = 1000;
/** Letters for the symbols up, left, right and down. */
const kLetters = ["u", "l", "r", "d"] as const;

/** Returns a circle that consists of four Bezier curves. */
function circle(x: number, y: number, r: number): string {
    const k = 0.5522847498 * r;
    const points = [
        [x + r, y + k, x + k, y + r, x, y + r],
        [x - k, y + r, x - r, y + k, x - r, y],
        [x - r, y - k, x - k, y - r, x, y - r],
        [x + k, y - r, x + r, y - k, x + r, y],
    ];
    const curves = points.map((curve) => `${curve.map((value) => value.toFixed(3)).join(" ")} c`);
    return `${(x + r).toFixed(3)} ${y.toFixed(3)} m ${curves.join(" ")} f\n`;
}

/** Returns the glyph of a symbol. The origin is the lower left corner of an undisplaced dot. */
function glyph(symbol: number): string {
    const per_mm = kUnitsPerEm / kSpacing_mm;
    const [dx, dy] = kSymbolStep[symbol]!;
    const r = (kDot_mm / 2) * per_mm;
    const x = r + dx * kDisplacement_mm * per_mm;
    const y = r - dy * kDisplacement_mm * per_mm;
    const box = [x - r, y - r, x + r, y + r].map((value) => value.toFixed(3)).join(" ");
    return `${kUnitsPerEm} 0 ${box} d1\n${circle(x, y, r)}`;
}

function dotFont(context: PDFContext): PDFRef {
    const glyphs = Object.fromEntries(
        kLetters.map((letter, symbol) => [letter, context.register(context.flateStream(glyph(symbol)))]),
    );
    const [first, last] = ["d".charCodeAt(0), "u".charCodeAt(0)];
    return context.register(
        context.obj({
            ...{ Type: "Font", Subtype: "Type3", FontMatrix: [0.001, 0, 0, 0.001, 0, 0] },
            // The bounding box is small so that renderers cache the glyphs as bitmaps.
            FontBBox: [-kUnitsPerEm / 2, -kUnitsPerEm / 2, kUnitsPerEm / 2, kUnitsPerEm / 2],
            ...{ FirstChar: first, LastChar: last, Widths: Array(last - first + 1).fill(kUnitsPerEm) },
            Encoding: {
                Type: "Encoding",
                Differences: [100, "d", 108, "l", 114, "r", 117, "u"].map((entry) =>
                    typeof entry === "string" ? PDFName.of(entry) : entry,
                ),
            },
            CharProcs: glyphs,
            Resources: {},
        }),
    );
}

/**
 * Returns the smallest shift for which all renderers round the origin of a glyph to the same pixel. Renderers truncate
 * or round, and count pixels from either edge of the page. If no shift of up to 0.3 px is sufficient, returns the shift
 * that is farthest from all rounding thresholds.
 */
function clearShift_px(near_px: number, far_px: number): number {
    const kClear_px = 0.05;
    const clearance = (shift: number) =>
        Math.min(
            1,
            ...[near_px + shift, far_px - shift].flatMap((place) =>
                [0.5, 1, 2].map((scale) => {
                    const halves = 2 * scale * place;
                    return Math.abs(halves - Math.round(halves)) / 2;
                }),
            ),
        );
    const shifts = Array.from({ length: 31 }, (_, step) => 0.01 * step);
    const clear = shifts.find((shift) => clearance(shift) >= kClear_px);
    return clear ?? shifts.reduce((best, shift) => (clearance(shift) > clearance(best) ? shift : best));
}

/** Returns the PDF operators that draw all dots, row by row. */
function dotContent(sheet: SheetLayout, symbols: Uint8Array): string {
    const px_per_mm = kDpi / 25.4;
    const shifted = (from_mm: number, size_mm: number) =>
        from_mm + clearShift_px(from_mm * px_per_mm, (size_mm - from_mm) * px_per_mm) / px_per_mm;
    const x_pt = shifted(sheet.first_x_mm - kDot_mm / 2, sheet.width_mm) * kPointsPerMm;
    const first_mm = shifted(sheet.first_y_mm + kDot_mm / 2, sheet.height_mm);
    const rows = Array.from({ length: sheet.rows }, (_, j) => {
        const y_mm = sheet.height_mm - first_mm - j * kSpacing_mm;
        const row = symbols.subarray(j * sheet.columns, (j + 1) * sheet.columns);
        const text = Array.from(row, (symbol) => kLetters[symbol]).join("");
        return `1 0 0 1 ${x_pt.toFixed(4)} ${(y_mm * kPointsPerMm).toFixed(4)} Tm(${text})Tj\n`;
    });
    const size_pt = (kSpacing_mm * kPointsPerMm).toFixed(9);
    // The empty ActualText keeps viewers from searching or copying the glyphs as letters.
    return `/Span <</ActualText ()>> BDC BT 0 0 0 1 k /Dots ${size_pt} Tf\n${rows.join("")}ET EMC\n`;
}

/**
 * Rounds a length on the page in the same way as the command-line tool, so renderers draw the same
 * pixels for both PDFs.
 */
function points(length_mm: number): number {
    return Math.round(length_mm * kPointsPerMm * 1e4) / 1e4;
}

/** Returns the bytes of the PDF. */
export async function sheetPdf(
    sheet: SheetLayout,
    symbols: Uint8Array,
    name: string,
): Promise<Uint8Array<ArrayBuffer>> {
    const pdf = await PDFDocument.create();
    pdf.setTitle(name);
    pdf.setCreator("dotpose");
    // Asks viewers not to scale the page to fit the paper.
    pdf.catalog.set(PDFName.of("ViewerPreferences"), pdf.context.obj({ PrintScaling: PDFName.of("None") }));
    const { context } = pdf;
    const label = context.obj({ Type: "Font", Subtype: "Type1", BaseFont: "Helvetica", Encoding: "WinAnsiEncoding" });
    const page = pdf.addPage([points(sheet.width_mm), points(sheet.height_mm)]);
    const contents = [dotContent(sheet, symbols), labelContent(sheet, name)];
    page.node.set(PDFName.of("Contents"), context.obj(contents.map((text) => context.register(context.flateStream(text)))));
    page.node.set(PDFName.of("Resources"), context.obj({ Font: { Dots: dotFont(context), Label: context.register(label) } }));
    return (await pdf.save()) as Uint8Array<ArrayBuffer>;
}
