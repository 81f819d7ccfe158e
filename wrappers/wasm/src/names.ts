// Names of the numbers in wrappers/c/dotpose.h.

export const kCodes = ["anoto", "libdots", "microdots"] as const;
/** Which table of the code a sheet is printed with: `anoto` for everything new. */
export type Code = (typeof kCodes)[number];

/** Returns the number of a table; throws RangeError for others. */
export function codeNumber(code: Code): number {
    const number = kCodes.indexOf(code);
    if (number < 0) throw new RangeError(`unknown code '${code}'; known are ${kCodes.join(", ")}`);
    return number;
}

export const kAttempts = ["tracked", "first", "second", "device"] as const;
/** What made a fix: `tracked` if the prediction was confirmed. */
export type Attempt = (typeof kAttempts)[number];

export const kSurfaces = ["even", "divided", "uneven"] as const;
/** Flatness of the paper in view, as determined from the dots. */
export type Surface = (typeof kSurfaces)[number];

/** One more coordinate per axis, 0 to 62: there are 63 x 63 sheets of all positions. */
export interface Section {
    u: number;
    v: number;
}

/** An intersection of the grid: column x and row y, 0 to 410,815,347. */
export interface Cell {
    x: number;
    y: number;
}
