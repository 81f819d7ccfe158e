// Text that describes robots and their alerts.
import { kSymbols } from "./marks.js";
import type { Alert, Condition } from "./messages.js";

export const kNothing = "–";

export function age(age_s: number): string {
    if (age_s < 100) return `${age_s.toFixed(1)} s`;
    if (age_s < 6000) return `${Math.round(age_s / 60)} min`;
    if (age_s < 360_000) return `${Math.round(age_s / 3600)} h`;
    return `${Math.round(age_s / 86_400)} days`;
}

export function number(value: number | undefined, digits: number): string {
    return value === undefined ? kNothing : value.toFixed(digits);
}

export function place({ map, sheet }: { map?: string; sheet?: string }): string {
    if (map === undefined) return kNothing;
    return sheet ? `${map} / ${sheet}` : map;
}

export function symbolOf(state: string): string {
    return kSymbols[state as Condition] ?? "";
}

export function time(time_us: number): string {
    return new Date(time_us / 1000).toLocaleTimeString("en-GB");
}

/** Describes the change that an alert reports. Omits the time and the robot. */
export function change(alert: Alert): string {
    const states = alert.previous ? `${alert.previous} → ${alert.state}` : alert.state;
    const details = [alert.reason, alert.map === undefined ? "" : place(alert)].filter((text) => text !== "");
    return [states, ...details].join(", ");
}
