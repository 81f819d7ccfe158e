// Formats numbers and names for display.
import type { Prior } from "dotpose";

export function mm(value: number, digits = 3): string {
    return `${value.toFixed(digits)} mm`;
}

/**
 * Formats millimetres with thin spaces between groups of three digits. Positions in the pattern have up to nine digits
 * before the decimal point.
 */
export function grouped(value_mm: number): string {
    return value_mm.toLocaleString("en", { minimumFractionDigits: 3, maximumFractionDigits: 3 }).replaceAll(",", "\u202f");
}

/** Formats a length in mm or µm. */
export function length(value_mm: number): string {
    const um = Math.abs(value_mm) * 1000;
    if (um >= 1000) return `${(um / 1000).toFixed(2)} mm`;
    return `${um.toFixed(um < 10 ? 1 : 0)} µm`;
}

export function degrees(rad: number, digits = 2): string {
    return `${((rad * 180) / Math.PI).toFixed(digits)}°`;
}

/** Formats an upper bound on a probability as "1 in N", where N is a power of ten. */
export function oneIn(probability: number): string {
    const power = Math.floor(-Math.log10(probability));
    const names = ["", "thousand", "million", "billion"];
    if (power > 11) return "< 1 in 10¹²";
    return `1 in ${10 ** (power % 3)} ${names[Math.floor(power / 3)]}`.trim();
}

/**
 * Names of the priors: the places that were considered possible when the probability of a wrong position was computed.
 */
export const kPriorNames: Record<Prior, string> = {
    plane: "all of the code",
    sheets: "known sheets",
    only_sheets: "only known sheets",
};

export function milliseconds(value_ms: number): string {
    return `${value_ms.toFixed(value_ms < 10 ? 2 : 0)} ms`;
}

/** Returns the equivalent angle in (-pi, pi]. */
export function wrapped(rad: number): number {
    return Math.atan2(Math.sin(rad), Math.cos(rad));
}
