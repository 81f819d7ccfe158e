// Shows the numbers beside the camera frame.
import type { Reading } from "../engine/messages.js";
import { element, show } from "../page/dom.js";
import { degrees, grouped, kPriorNames, length, milliseconds, oneIn } from "../page/format.js";
import { pageFromPattern } from "../page/sheet_frame.js";
import type { KnownSheet } from "../print/known_sheets.js";

const kNames = ["x", "y", "angle", "sigma", "sheet", "prior", "wrong", "spacing"];

/** Shows a reading. If the sheet is known, positions are relative to the corner of its page. */
export function showReading({ fix, locate_ms }: Reading, sheet: KnownSheet | null): void {
    element("look-readout", HTMLElement).classList.toggle("lost", !fix.ok);
    show({ "look-time": milliseconds(locate_ms), "look-dots": String(fix.ok ? fix.dots_used : fix.dots_seen) });
    if (!fix.ok) {
        for (const name of kNames) show({ [`look-${name}`]: "–" });
        return;
    }
    const place = sheet ? pageFromPattern(sheet.layout, fix) : fix;
    const where = sheet ? "on the page" : "in the pattern";
    show({
        "look-x-name": `x ${where}, mm`,
        "look-y-name": `y ${where}, mm`,
        "look-x": grouped(place.x_mm),
        "look-y": grouped(place.y_mm),
        "look-angle": degrees(fix.theta_rad),
        "look-sigma": length(Math.sqrt(Math.max(fix.covariance[0]!, fix.covariance[4]!))),
        "look-sheet": sheet?.name ?? "not known",
        "look-prior": kPriorNames[fix.prior],
        "look-wrong": oneIn(fix.p_wrong),
        "look-spacing": `${fix.spacing_px.toFixed(1)} px`,
    });
}
