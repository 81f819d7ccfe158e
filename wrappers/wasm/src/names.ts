// Names of the enumeration values in wrappers/c/dotpose.h.

/** All values of `Code`, indexed by their numbers in C. */
export const kCodes = ["anoto", "libdots", "microdots"] as const;
/** Code variants of printed sheets. Use `anoto` for new sheets. */
export type Code = (typeof kCodes)[number];

/** Returns the number of a code. Throws RangeError for an unknown name. */
export function codeNumber(code: Code): number {
    const number = kCodes.indexOf(code);
    if (number < 0) throw new RangeError(`unknown code '${code}'; known are ${kCodes.join(", ")}`);
    return number;
}

/** All values of `Attempt`, indexed by their numbers in C. */
export const kAttempts = ["tracked", "first", "second", "device"] as const;
/** Attempt that produced a fix. `tracked` means that the frame confirmed the prediction. */
export type Attempt = (typeof kAttempts)[number];

/** All values of `Surface`, indexed by their numbers in C. */
export const kSurfaces = ["even", "divided", "uneven"] as const;
/** Flatness of the paper in view, as determined from the dots. */
export type Surface = (typeof kSurfaces)[number];

/** All values of `Prior`, indexed by their numbers in C. */
export const kPriors = ["plane", "sheets", "only_sheets"] as const;
/** Places that were considered possible when `p_wrong` was computed. */
export type Prior = (typeof kPriors)[number];

/** All values of `MapUse`, indexed by their numbers in C. */
export const kMapUses = ["no_map", "used", "not_covered", "contradicted"] as const;
/**
 * Use of a print map:
 * - `no_map`: there is no map of the page in view.
 * - `used`: the fix is corrected.
 * - `not_covered`: the map contains too few of the dots in view.
 * - `contradicted`: the map belongs to another print.
 */
export type MapUse = (typeof kMapUses)[number];

/** All values of `Verdict`, indexed by their numbers in C. */
export const kVerdicts = ["none", "accepted", "with_prior", "gated", "too_weak"] as const;
/** A tracker's verdict on the fix of a frame. `none` means that there was no fix. */
export type Verdict = (typeof kVerdicts)[number];

/** All values of `TrackEvent`, in the order of their bits in C. */
export const kTrackEvents = ["fix", "lost", "kidnapped", "stationary", "moving"] as const;
/** A change in the state of a robot. */
export type TrackEvent = (typeof kTrackEvents)[number];

/** Section of the code, 0 to 62 per axis. Each of the 63 x 63 sections contains all cells. */
export interface Section {
    /** Roll of column 0: the offset at which the main sequence starts, 0 to 62. */
    u: number;
    /** Roll of row 0, 0 to 62. */
    v: number;
}

/** An intersection of the grid: column x and row y, each from 0 to 410,815,347. */
export interface Cell {
    /** Column, which increases to the right. */
    x: number;
    /** Row, which increases downwards. */
    y: number;
}

/** A printed rectangle of the code plane. */
export interface KnownRegion {
    /** Code of the region. Default: "anoto". */
    code?: Code;
    /** Section of the code. Default: 0, 0. */
    section?: Section;
    /** Upper left intersection. */
    first: Cell;
    /** Number of columns of intersections, at least 1. */
    columns: number;
    /** Number of rows of intersections, at least 1. */
    rows: number;
}
