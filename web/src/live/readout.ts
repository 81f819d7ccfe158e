// Shows the numbers of the newest frame.
import { element, show } from "../page/dom.js";
import { grouped, length, oneIn } from "../page/format.js";
import type { Line, Setup, State } from "./messages.js";

const kNothing = "–";
const kStates: Record<Line["state"], string> = { lost: "lost", moving: "moving", stationary: "still" };

interface Place {
    frame: string;
    x_mm: number;
    y_mm: number;
    angle_deg: number;
}

/**
 * Returns the pose on the sheet. Returns the tracked pose instead if poses are reported in the world, or if the sheet
 * is not known. Returns null if there is no pose.
 */
export function placeOf(line: Line, setup: Setup | null): Place | null {
    if (setup?.plane !== "world" && typeof line.x_sheet_mm === "number") {
        return {
            frame: `sheet ${line.sheet}`,
            x_mm: line.x_sheet_mm,
            y_mm: line.y_sheet_mm!,
            angle_deg: line.theta_sheet_deg!,
        };
    }
    if (typeof line.track_x_mm !== "number") return null;
    return {
        frame: setup?.plane ?? "pattern",
        x_mm: line.track_x_mm,
        y_mm: line.track_y_mm!,
        angle_deg: line.track_theta_deg!,
    };
}

function percent(part: number, whole: number): string {
    return whole === 0 ? kNothing : `${((100 * part) / whole).toFixed(1)} %`;
}

function number(value: number | null | undefined, format: (value: number) => string): string {
    return typeof value === "number" ? format(value) : kNothing;
}

export function showState({ line, ...run }: State, setup: Setup | null): void {
    const place = placeOf(line, setup);
    const frame = place ? ` (${place.frame})` : "";
    const speed = line.vx_mm_s == null ? null : Math.hypot(line.vx_mm_s, line.vy_mm_s!);
    element("live-readout", HTMLElement).classList.toggle("lost", place === null);
    show({
        "live-x-name": `x${frame}, mm`,
        "live-y-name": `y${frame}, mm`,
        "live-x": place ? grouped(place.x_mm) : kNothing,
        "live-y": place ? grouped(place.y_mm) : kNothing,
        "live-angle": place ? `${place.angle_deg.toFixed(2)}°` : kNothing,
        "live-speed": number(speed, (value) => `${value.toFixed(1)} mm/s`),
        "live-state": kStates[line.state],
        "live-sigma": number(line.track_sigma_mm, length),
        "live-wrong": number(line.p_wrong, oneIn),
        "live-dots": String(line.status === "ok" ? line.dots_used : line.dots_seen),
        "live-bits": number(line.bit_errors, String),
        "live-spacing": number(line.spacing_px, (value) => `${value.toFixed(1)} px`),
        "live-rate": `${run.rate_hz.toFixed(1)} frames/s`,
        "live-located": percent(run.fixes, run.frames),
        "live-counts": `frame ${line.frame}, ${line.t_s.toFixed(3)} s; ${run.frames} frames, ${run.dropped} dropped, ${run.lost} ${run.lost === 1 ? "time" : "times"} lost`,
        "live-warnings": run.warnings.join(". "),
    });
    element("live-warnings", HTMLElement).hidden = run.warnings.length === 0;
}
