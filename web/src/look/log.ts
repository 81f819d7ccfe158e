// The log of readings, with a subset of the CSV columns of `dotpose watch --log` (docs/output.md). `dotpose replay` can
// read the log. The page has no tracker. The track columns therefore contain the fix, and the velocity is computed from
// this fix and the previous fix.
import type { Reading } from "../engine/messages.js";
import { pageFromPattern } from "../page/sheet_frame.js";
import type { KnownSheet } from "../print/known_sheets.js";

const kDegrees = 180 / Math.PI;

interface Frame {
    reading: Reading;
    number: number;
    /** The known sheet that contains the fix, or null. */
    sheet: KnownSheet | null;
    /** The previous frame, or undefined for the first frame. */
    before: Reading | undefined;
}

/** Turns a string into a valid CSV field by replacing commas, quotation marks and white space. */
const withoutCommas = (text: string) => text.replaceAll(/[,"\s]+/g, (match) => (match.includes(",") ? "; " : " "));

type Column = readonly [name: string, value: (frame: Frame) => string | number, always?: true];

const sigma = ({ reading }: Frame, i: number) => Math.sqrt(reading.fix.covariance[4 * i]!);

const isFound = ({ before }: Frame) => before?.fix.ok ?? false;

/** Returns the event of this frame, with the same name as in the command-line tool. */
function eventOf(frame: Frame): string {
    if (frame.reading.fix.ok) return isFound(frame) ? "" : "fix";
    return isFound(frame) ? "lost" : "";
}

/**
 * Returns the rate of change of a quantity since the previous frame, or 0 if the previous frame has
 * no fix.
 */
function speed(frame: Frame, of: (reading: Reading) => number, turns = false): string {
    const { reading, before } = frame;
    const took_s = before ? reading.time_s - before.time_s : 0;
    if (!before?.fix.ok || took_s <= 0) return "0";
    const way = of(reading) - of(before);
    return ((turns ? way - 360 * Math.round(way / 360) : way) / took_s).toFixed(3);
}

const x_mm = ({ fix }: Reading) => fix.x_mm;
const y_mm = ({ fix }: Reading) => fix.y_mm;
const onSheet = ({ sheet, reading }: Frame) => (sheet ? pageFromPattern(sheet.layout, reading.fix) : null);
const theta_deg = ({ fix }: Reading) => fix.theta_rad * kDegrees;

const inDegrees = (rad: number | undefined) => (rad === undefined ? "" : (rad * kDegrees).toFixed(6));

/** Columns of the log. For frames without a fix, only the columns marked `always` have values. */
const kColumns: readonly Column[] = [
    ["schema", () => 1, true],
    ["frame", ({ number }) => number, true],
    ["t_s", ({ reading }) => reading.time_s.toFixed(6), true],
    ["status", ({ reading }) => reading.fix.status, true],
    ["message", ({ reading: { fix } }) => (fix.ok ? "" : withoutCommas(fix.message)), true],
    ["x_mm", ({ reading }) => x_mm(reading).toFixed(6)],
    ["y_mm", ({ reading }) => y_mm(reading).toFixed(6)],
    ["theta_deg", ({ reading }) => theta_deg(reading).toFixed(6)],
    ["section_u", ({ reading }) => reading.fix.section.u],
    ["section_v", ({ reading }) => reading.fix.section.v],
    ["dots_seen", ({ reading }) => reading.fix.dots_seen, true],
    ["dots_used", ({ reading }) => reading.fix.dots_used],
    ["attempt", ({ reading }) => reading.fix.attempt],
    ["surface", ({ reading }) => reading.fix.surface],
    ["bit_errors", ({ reading }) => reading.fix.bit_errors],
    ["p_wrong", ({ reading }) => reading.fix.p_wrong.toExponential(2)],
    ["prior", ({ reading }) => reading.fix.prior],
    ["sigma_x_mm", (frame) => sigma(frame, 0).toFixed(6)],
    ["sigma_y_mm", (frame) => sigma(frame, 1).toFixed(6)],
    ["sigma_theta_deg", (frame) => (sigma(frame, 2) * kDegrees).toFixed(6)],
    ["residual_px", ({ reading }) => reading.fix.residual_px.toFixed(4)],
    ["spacing_px", ({ reading }) => reading.fix.spacing_px.toFixed(4)],
    ["elapsed_us", ({ reading }) => Math.round(1000 * reading.locate_ms), true],
    ["code", ({ reading }) => reading.fix.code],
    ["sheet", ({ sheet }) => (sheet ? withoutCommas(sheet.name) : "")],
    ["x_sheet_mm", (frame) => onSheet(frame)?.x_mm.toFixed(6) ?? ""],
    ["y_sheet_mm", (frame) => onSheet(frame)?.y_mm.toFixed(6) ?? ""],
    ["camera_x_mm", ({ reading }) => reading.fix.space?.position_mm[0].toFixed(6) ?? ""],
    ["camera_y_mm", ({ reading }) => reading.fix.space?.position_mm[1].toFixed(6) ?? ""],
    ["camera_z_mm", ({ reading }) => reading.fix.space?.position_mm[2].toFixed(6) ?? ""],
    ["camera_tilt_deg", ({ reading }) => inDegrees(reading.fix.space?.tilt_rad)],
    ["camera_azimuth_deg", ({ reading }) => inDegrees(reading.fix.space?.azimuth_rad)],
    ["camera_turn_deg", ({ reading }) => inDegrees(reading.fix.space?.turn_rad)],
    ["camera_is_ambiguous", ({ reading }) => String(reading.fix.space?.is_ambiguous ?? "")],
    ["state", ({ reading }) => (reading.fix.ok ? "moving" : "lost"), true],
    ["events", eventOf, true],
    ["verdict", ({ reading }) => (reading.fix.ok ? "accepted" : "none"), true],
    ["plane", () => "pattern"],
    ["track_x_mm", ({ reading }) => x_mm(reading).toFixed(6)],
    ["track_y_mm", ({ reading }) => y_mm(reading).toFixed(6)],
    ["track_theta_deg", ({ reading }) => theta_deg(reading).toFixed(6)],
    ["vx_mm_s", (frame) => speed(frame, x_mm)],
    ["vy_mm_s", (frame) => speed(frame, y_mm)],
    ["turn_deg_s", (frame) => speed(frame, theta_deg, true)],
];

/** Maximum number of lines in the log, about an hour at 30 frames per second. */
const kMaxLines = 100_000;

export class Log {
    #lines: string[] = [];
    #frames = 0;
    #first_s: number | undefined;
    #before: Reading | undefined;

    get length(): number {
        return this.#lines.length;
    }

    /** Adds a line. `sheet` is the known sheet that contains the fix, or null. Times are relative to the first line. */
    add(reading: Reading, sheet: KnownSheet | null): void {
        this.#first_s ??= reading.time_s;
        const timed = { ...reading, time_s: reading.time_s - this.#first_s };
        const frame = { reading: timed, number: this.#frames++, sheet, before: this.#before };
        this.#before = timed;
        const line = kColumns.map(([, value, always]) => (always || reading.fix.ok ? value(frame) : ""));
        this.#lines.push(line.join(","));
        if (this.#lines.length > kMaxLines) this.#lines.shift();
    }

    clear(): void {
        this.#lines = [];
        this.#frames = 0;
        this.#first_s = undefined;
        this.#before = undefined;
    }

    text(): string {
        return `${[kColumns.map(([name]) => name).join(","), ...this.#lines].join("\n")}\n`;
    }
}
