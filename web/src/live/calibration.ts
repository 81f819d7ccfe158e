// The /calibration page of `dotpose watch --web`: calibrates the camera in use, step by step.
import { announcer, element, make, show } from "../page/dom.js";
import { drawMissing, drawResiduals, drawSpin, drawTilts, drawTurns, fullScale_px, kMaxLean, kMaxTilt } from "./calibration_drawings.js";
import type { CalibrationState, CalibrationValue, Gauge, LensCoverage, Result } from "./calibration_state.js";
import { StepList, stepOf, typeset } from "./calibration_steps.js";
import { Connection, type Value } from "./connection.js";
import { sourceText, type Setup } from "./messages.js";
import { Picture } from "./picture.js";

const kTitles: Record<CalibrationState["phase"], string> = {
    idle: "",
    collecting: "taking frames",
    solving: "calculating",
    solved: "result",
    failed: "no result",
    saved: "saved",
};

const announce = announcer("live-announced");
const connection = new Connection((is_open) => {
    element("live-status", HTMLElement).classList.toggle("good", is_open);
    show({ "live-status": is_open ? "live" : "no connection to dotpose" });
    if (!is_open) announce("No connection to dotpose");
});
const frame = element("live-frame", HTMLCanvasElement);
const picture = new Picture(connection, () => {
    if (shown?.phase === "collecting" && shown.lens !== null) drawMissing(frame, shown.lens);
});
const steps = new StepList((step) => send("start", { step }));
let shown: CalibrationState | null = null;

function send(action: string, more: Record<string, string> = {}): void {
    connection.send({ do: "calibrate", action, ...more });
}

function setHidden(id: string, is_hidden: boolean): void {
    element(id, HTMLElement).hidden = is_hidden;
}

function showGauges(gauges: readonly Gauge[]): void {
    const box = element("calibration-gauges", HTMLElement);
    // The elements are reused, because screen readers would read new elements aloud again.
    if (box.childElementCount !== 3 * gauges.length) {
        box.replaceChildren(
            ...gauges.flatMap((_, i) => [
                make("label", { htmlFor: `calibration-gauge-${i}` }),
                make("meter", { id: `calibration-gauge-${i}`, min: 0, max: 1 }),
                make("output", {}),
            ]),
        );
    }
    gauges.forEach(({ label, text, fraction, is_reached }, i) => {
        const [name, meter, output] = [...box.children].slice(3 * i) as [HTMLElement, HTMLMeterElement, HTMLElement];
        name.textContent = label;
        meter.value = is_reached ? 1 : Math.min(fraction, 0.99);
        output.textContent = typeset(is_reached ? `${text}, enough` : text);
    });
}

function sentence(text: string): string {
    return text === "" ? "" : `${text[0]!.toUpperCase()}${text.slice(1)}.`;
}

function showList(id: string, texts: readonly string[]): void {
    const list = element(id, HTMLElement);
    if ([...list.children].map((item) => item.textContent).join("\n") === texts.join("\n")) return;
    list.replaceChildren(...texts.map((text) => make("li", { textContent: text })));
}

/** Describes how many sectors of a turn have been seen. */
function turnsText(seen: readonly boolean[]): string {
    return `Turns: ${seen.filter(Boolean).length} of ${seen.length} directions seen`;
}

function tiltsText(tilts: LensCoverage["tilts"]): string {
    const largest = Math.max(0, ...tilts.map(([u, v]) => Math.hypot(u, v)));
    return `Tilts: the scale changes by up to ${(100 * largest).toFixed(1)} % towards a corner`;
}

function leansText(leans: CalibrationState["leans"]): string {
    const largest_deg = (Math.atan(Math.max(0, ...leans.map(([x, y]) => Math.hypot(x, y)))) * 180) / Math.PI;
    return `Tilts of the pen on the sheet: up to ${largest_deg.toFixed(0)}°`;
}

function draw(id: string, text: string, paint: (canvas: HTMLCanvasElement) => void): void {
    const canvas = element(id, HTMLCanvasElement);
    canvas.setAttribute("aria-label", text);
    // Draws nothing if the canvas is in a hidden part of the page, where it has no size.
    if (canvas.clientWidth > 0) paint(canvas);
}

/** Shows the tilts, and which directions have been seen. */
function showDials({ lens, step, directions, leans }: CalibrationState): void {
    const is_pen = step === "pivot";
    const seen = lens?.directions ?? directions;
    setHidden("calibration-turns-figure", seen.length === 0);
    setHidden("calibration-tilts-figure", lens === null && !is_pen);
    if (seen.length > 0) {
        const text = is_pen ? `Sides: ${seen.filter(Boolean).length} of ${seen.length} with enough tilts` : turnsText(seen);
        show({ "calibration-turns-text": text });
        // For a pen, the first sector is centred on direction 0, so it begins half a sector earlier.
        draw("calibration-turns", text, (canvas) => drawTurns(canvas, seen, lens?.theta_rad ?? null, is_pen ? -0.5 : 0));
    }
    const [tilts, max, text] = lens !== null ? [lens.tilts, kMaxTilt, tiltsText(lens.tilts)] : [leans, kMaxLean, leansText(leans)];
    if (lens === null && !is_pen) return;
    show({ "calibration-tilts-text": text });
    draw("calibration-tilts", text, (canvas) => drawTilts(canvas, tilts, max));
}

function showProgress(state: CalibrationState): void {
    const { lens } = state;
    show({
        "calibration-frames": `${state.frames} ${state.frames === 1 ? "frame" : "frames"} taken`,
        "calibration-remark": sentence(lens?.remark ?? ""),
    });
    showGauges(state.gauges);
    const needs = lens?.needs ?? state.needs;
    showList("calibration-needs", needs.map(typeset));
    setHidden("calibration-missing", needs.length === 0);
    showDials(state);
}

function showResult(result: Result, is_saved: boolean, file: string): void {
    const verdict = element("calibration-verdict", HTMLElement);
    verdict.classList.toggle("good", result.is_good);
    const accepted = result.is_good ? "Accepted" : "Usable, with a warning: see the verdict";
    verdict.textContent = is_saved ? `Saved in ${file}. The run uses it.` : `${accepted}. It is not saved yet.`;
    const improvements = result.improvements.map(typeset).join("; ");
    show({ "calibration-improvements": improvements === "" ? "" : `It could be improved: ${improvements}.` });
    const report = element("calibration-report", HTMLElement);
    report.replaceChildren(
        ...result.rows.map(([label, text]) => make("div", {}, make("dt", { textContent: label }), make("dd", { textContent: typeset(text) }))),
    );
    const { residuals, stations_mm } = result;
    setHidden("calibration-field-figure", residuals === null);
    setHidden("calibration-spin-figure", stations_mm.length === 0);
    if (residuals !== null) {
        const [before, after] = [fullScale_px(residuals.before).toFixed(2), fullScale_px(residuals.after).toFixed(2)];
        show({ "calibration-field-text": `Residuals of the dots before (left; the longest arrow is ${before} px) and after (right; ${after} px)` });
        draw("calibration-before", `Residuals before: up to ${before} px`, (canvas) => drawResiduals(canvas, residuals, residuals.before, "--warn"));
        draw("calibration-after", `Residuals after: up to ${after} px`, (canvas) => drawResiduals(canvas, residuals, residuals.after, "--good"));
    }
    if (stations_mm.length > 0) {
        const text = `The camera at its ${stations_mm.length} places around the centre of the turn`;
        show({ "calibration-spin-text": text });
        draw("calibration-spin", text, (canvas) => drawSpin(canvas, stations_mm));
    }
}

function showStep(state: CalibrationState): void {
    const { phase, step, file } = state;
    const { title, task } = stepOf(step);
    const is_collecting = phase === "collecting";
    show({
        "calibration-title": `${title}: ${kTitles[phase]}`,
        "calibration-task": is_collecting ? task : "",
        "calibration-now": sentence(state.advice),
        "calibration-problem": sentence(state.problem),
        "calibration-save": `Save as ${file}`,
        "calibration-file": `Save writes ${file}. The values of the other steps are kept.`,
    });
    const has_result = state.result !== null && (phase === "solved" || phase === "saved");
    setHidden("calibration-current", phase === "idle");
    setHidden("calibration-now", !is_collecting);
    setHidden("calibration-legend", !is_collecting || state.lens === null);
    setHidden("calibration-problem", state.problem === "");
    setHidden("calibration-progress", has_result || (phase === "failed" && state.lens === null));
    setHidden("calibration-result", !has_result);
    setHidden("calibration-save", phase !== "solved");
    setHidden("calibration-finish", !is_collecting);
    setHidden("calibration-cancel", phase === "idle");
    element("calibration-finish", HTMLButtonElement).disabled = state.frames < 2;
    show({ "calibration-cancel": phase === "collecting" || phase === "solving" ? "Cancel" : phase === "solved" ? "Discard" : "Close" });
    if (!element("calibration-progress", HTMLElement).hidden) showProgress(state);
    if (has_result) showResult(state.result!, phase === "saved", file);
}

function take(value: CalibrationValue): void {
    const before = shown;
    shown = value.file === null ? null : value;
    setHidden("calibration-off", shown !== null);
    steps.show(shown);
    if (shown === null) return;
    showStep(shown);
    const is_new = before?.phase !== shown.phase;
    if (is_new && shown.phase !== "idle") announce(`${stepOf(shown.step).title}: ${kTitles[shown.phase]}. ${shown.problem}`);
    else if (shown.advice !== before?.advice && shown.advice !== "") announce(shown.advice);
}

for (const action of ["save", "finish", "cancel"])
    element(`calibration-${action}`, HTMLButtonElement).addEventListener("click", () => send(action));
connection.subscribe("setup", (value: Value) => {
    const setup = JSON.parse(value as string) as Setup;
    show({ "live-robot": setup.robot, "live-source": sourceText(setup) });
    document.title = `${setup.robot}: calibration`;
});
connection.subscribe("calibration", async (value: Value) => {
    take(JSON.parse(value as string) as CalibrationValue);
    await new Promise(requestAnimationFrame);
});
connection.open();

function redraw(): void {
    picture.request();
    picture.redraw();
    if (shown !== null) showStep(shown);
}
window.addEventListener("resize", redraw);
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
