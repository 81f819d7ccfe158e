// The log of readings: those columns of the tool's CSV files that one frame has (docs/output.md).
import type { Reading } from "../engine/messages.js";

const kDegrees = 180 / Math.PI;

type Column = readonly [name: string, value: (reading: Reading, frame: number) => string | number, always?: true];

const sigma = (reading: Reading, i: number) => Math.sqrt(reading.fix.covariance[4 * i]!);

/** Values are of located frames only, unless `always`. */
const kColumns: readonly Column[] = [
    ["schema", () => 1, true],
    ["frame", (_, frame) => frame, true],
    ["t_s", ({ time_s }) => time_s.toFixed(6), true],
    ["status", ({ fix }) => fix.status, true],
    ["message", ({ fix }) => (fix.ok ? "" : fix.message.replaceAll(",", ";")), true],
    ["x_mm", ({ fix }) => fix.x_mm.toFixed(6)],
    ["y_mm", ({ fix }) => fix.y_mm.toFixed(6)],
    ["theta_deg", ({ fix }) => (fix.theta_rad * kDegrees).toFixed(6)],
    ["section_u", ({ fix }) => fix.section.u],
    ["section_v", ({ fix }) => fix.section.v],
    ["dots_seen", ({ fix }) => fix.dots_seen, true],
    ["dots_used", ({ fix }) => fix.dots_used],
    ["attempt", ({ fix }) => fix.attempt],
    ["surface", ({ fix }) => fix.surface],
    ["bit_errors", ({ fix }) => fix.bit_errors],
    ["p_wrong", ({ fix }) => fix.p_wrong.toExponential(2)],
    ["sigma_x_mm", (reading) => sigma(reading, 0).toFixed(6)],
    ["sigma_y_mm", (reading) => sigma(reading, 1).toFixed(6)],
    ["sigma_theta_deg", (reading) => (sigma(reading, 2) * kDegrees).toFixed(6)],
    ["residual_px", ({ fix }) => fix.residual_px.toFixed(4)],
    ["spacing_px", ({ fix }) => fix.spacing_px.toFixed(4)],
    ["elapsed_us", ({ locate_ms }) => Math.round(1000 * locate_ms), true],
    ["code", ({ fix }) => fix.code],
];

/** Longest log that is kept, about an hour at 30 frames per second. */
const kMostLines = 100_000;

export class Log {
    #lines: string[] = [];
    #frames = 0;
    #first_s: number | undefined;

    get length(): number {
        return this.#lines.length;
    }

    /** Adds a line; the time counts from the first one. */
    add(reading: Reading): void {
        this.#first_s ??= reading.time_s;
        const timed = { ...reading, time_s: reading.time_s - this.#first_s };
        const frame = this.#frames++;
        const line = kColumns.map(([, value, always]) => (always || reading.fix.ok ? value(timed, frame) : ""));
        this.#lines.push(line.join(","));
        if (this.#lines.length > kMostLines) this.#lines.shift();
    }

    clear(): void {
        this.#lines = [];
        this.#frames = 0;
        this.#first_s = undefined;
    }

    text(): string {
        return `${[kColumns.map(([name]) => name).join(","), ...this.#lines].join("\n")}\n`;
    }
}
