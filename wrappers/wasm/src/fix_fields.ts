// Written by scripts/generate-fields from include/dotpose/fix_fields.def.
import { type Attempt, type Surface, kAttempts, kSurfaces } from "./names.js";

/** Size of a dotpose_fix of wrappers/c/dotpose.h. */
export const kFixBytes = 240;

/** Offsets of its members. */
export const kAt = {
    status: 4,
    x_mm: 8,
    y_mm: 16,
    theta_rad: 24,
    p_wrong: 32,
    p_wrong_log2: 40,
    dots_seen: 44,
    dots_used: 48,
    attempt: 52,
    surface: 56,
    bit_errors: 60,
    residual_px: 64,
    covariance: 68,
    section_u: 104,
    section_v: 108,
    cell_x: 112,
    cell_y: 116,
    fraction_x_q16: 120,
    fraction_y_q16: 124,
    theta_bam: 128,
    spacing_px_q16: 132,
    spacing_nm: 136,
    place: 140,
    pattern_from_image: 156,
    displacement_q16: 200,
    covariance_grid: 204,
} as const;

/** The fields of a fix that are plain values. */
export interface FixFields {
    /**
     * x of the pattern point under the reference point, to the right, in mm; NaN if the spacing of the sheet is
     * not known.
     */
    x_mm: number;
    /**
     * y of the pattern point under the reference point, DOWN the page, in mm; NaN if the spacing of the sheet is
     * not known.
     */
    y_mm: number;
    /**
     * Angle of the image x axis in the pattern, from +x towards +y: clockwise as seen on the paper, in [-pi,
     * pi).
     */
    theta_rad: number;
    /** Upper bound of the probability that the position is wrong. */
    p_wrong: number;
    /** Blobs of the size of a dot. */
    dots_seen: number;
    /** Dots to which the pose was fitted. */
    dots_used: number;
    /** The attempt that made the fix. */
    attempt: Attempt;
    /** Flatness of the paper in view, as determined from the dots. */
    surface: Surface;
    /** Number of bits that contradict the position; each cell read has two bits. */
    bit_errors: number;
    /** Root mean square distance of the dots from their fitted places, per axis, in px. */
    residual_px: number;
}

/** Returns the plain values of a dotpose_fix. */
export function fieldsOf(view: DataView): FixFields {
    return {
        x_mm: view.getFloat64(8, true),
        y_mm: view.getFloat64(16, true),
        theta_rad: view.getFloat64(24, true),
        p_wrong: view.getFloat64(32, true),
        dots_seen: view.getInt32(44, true),
        dots_used: view.getInt32(48, true),
        attempt: kAttempts[view.getInt32(52, true)]!,
        surface: kSurfaces[view.getInt32(56, true)]!,
        bit_errors: view.getInt32(60, true),
        residual_px: view.getFloat32(64, true),
    };
}
