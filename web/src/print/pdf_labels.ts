// Labels in the margins of a printed sheet: a description, and rulers in millimetres from the corner of the page. The
// labels are identical to the labels that the command-line tool prints.
import type { SheetLayout } from "../engine/messages.js";
import { kSpacing_mm } from "../page/sheet_frame.js";
import { kPointsPerMm, shown } from "./pdf_text.js";

const kGap_mm = 0.8;
const kTick_mm = { 10: 1.8, 5: 1.2, 1: 0.8 };
const kNumber_pt = 4.5;
const kText_pt = 6;
/** Space that a ruler needs between the dots and the edge of the page. */
const kRulerRoom_mm = 4.4;
const kTextRoom_mm = 3.6;
/** Distance from an intersection to the farthest edge of its dot. */
const kReach_mm = kSpacing_mm / 4;

/** Returns a ruler with ticks and numbers along the upper edge (`x`) or the left edge (`y`). */
function ruler(sheet: SheetLayout, axis: "x" | "y"): string {
    const is_x = axis === "x";
    const ink_mm = (is_x ? sheet.first_y_mm : sheet.first_x_mm) - kReach_mm;
    if (ink_mm < kRulerRoom_mm) return "";
    const at = (along_mm: number, away_mm: number) => {
        const [x_mm, y_mm] = is_x ? [along_mm, ink_mm - away_mm] : [ink_mm - away_mm, along_mm];
        return `${(x_mm * kPointsPerMm).toFixed(3)} ${((sheet.height_mm - y_mm) * kPointsPerMm).toFixed(3)}`;
    };
    const first_mm = is_x ? sheet.first_x_mm : sheet.first_y_mm;
    const last_mm = first_mm + ((is_x ? sheet.columns : sheet.rows) - 1) * kSpacing_mm;
    let ticks = `${(0.1 * kPointsPerMm).toFixed(3)} w\n`;
    let numbers = `BT /Label ${kNumber_pt} Tf\n`;
    for (let mm = Math.ceil(first_mm); mm <= last_mm; ++mm) {
        const long = mm % 10 === 0 ? kTick_mm[10] : mm % 5 === 0 ? kTick_mm[5] : kTick_mm[1];
        ticks += `${at(mm, kGap_mm)} m ${at(mm, kGap_mm + long)} l\n`;
        if (mm % 10 !== 0) continue;
        const half_mm = (String(mm).length * 0.556 * kNumber_pt) / 2 / kPointsPerMm;
        const turn = is_x ? "1 0 0 1" : "0 1 -1 0";
        numbers += `${turn} ${at(is_x ? mm - half_mm : mm + half_mm, kGap_mm + kTick_mm[10] + 0.3)} Tm ${shown(String(mm))} Tj\n`;
    }
    return `${ticks}S\n${numbers}ET\n`;
}

function description(sheet: SheetLayout, name: string): string {
    const { origin, columns, rows, section } = sheet;
    const end = `${origin.x + columns - 1},${origin.y + rows - 1}`;
    const cells = `cells ${origin.x},${origin.y} to ${end}, section ${section.u},${section.v}`;
    return `${name}, ${cells}, code ${sheet.code}, spacing ${kSpacing_mm} mm, for 600 dpi, print at 100 %`;
}

/** Returns the PDF content of all labels that fit into the margins. */
export function labelContent(sheet: SheetLayout, name: string): string {
    const ink_end_mm = sheet.first_y_mm + (sheet.rows - 1) * kSpacing_mm + kReach_mm;
    const baseline_mm = ink_end_mm + kGap_mm + 2;
    let text = "";
    if (sheet.height_mm - ink_end_mm >= kTextRoom_mm) {
        const x = ((sheet.first_x_mm - kReach_mm) * kPointsPerMm).toFixed(3);
        const y = ((sheet.height_mm - baseline_mm) * kPointsPerMm).toFixed(3);
        text = `BT /Label ${kText_pt} Tf 1 0 0 1 ${x} ${y} Tm ${shown(description(sheet, name))} Tj ET\n`;
    }
    return `q 0 0 0 1 k 0 0 0 1 K\n${text}${ruler(sheet, "x")}${ruler(sheet, "y")}Q\n`;
}
