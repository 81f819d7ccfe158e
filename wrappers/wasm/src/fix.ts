// The pose that one frame shows, read from a dotpose_fix of wrappers/c/dotpose.h.
import { kAttempts, kCodes, kSurfaces, type Attempt, type Cell, type Code, type Section, type Surface } from "./names.js";

/** Size of a dotpose_fix. */
export const kFixBytes = 240;

/**
 * The pose that one frame shows, with its evidence; plain data, which workers can send.
 *
 * The pattern has x to the right and y DOWN, as the printed page is read. The pose is that of the pattern
 * under the centre of the image. Unless `ok`, pose and covariance are not numbers, and only `status`,
 * `message` and `dots_seen` count.
 */
export interface Fix {
    /** Whether there is a pose. A frame without one is a normal result; `message` says why. */
    ok: boolean;
    /** Identifier, for example "ok" or "too_few_dots". */
    status: string;
    /** One plain sentence for the user, without a full stop. */
    message: string;
    x_mm: number;
    y_mm: number;
    /** Angle of the image's x axis in the pattern, from +x towards +y: clockwise as seen on the paper. */
    theta_rad: number;
    /** Covariance of x, y and theta, in mm and rad: nine numbers, row by row. */
    covariance: Float32Array;
    /** The position is wrong with at most this probability. */
    p_wrong: number;
    section: Section;
    /** Intersection to the upper left of the pose. */
    cell: Cell;
    /** Table of the code in which the frame was read. */
    code: Code;
    attempt: Attempt;
    surface: Surface;
    /** Spacing of the printed grid. */
    spacing_mm: number;
    /** Spacing of the grid in the image. */
    spacing_px: number;
    /** Root mean square distance of the dots from where they should be. */
    residual_px: number;
    dots_seen: number;
    dots_used: number;
    bit_errors: number;
    /** Centres of the dots found, u and v in px from the first pixel's centre; null unless asked for. */
    dots: Float32Array | null;
    /** The same fix to the last bit: a dotpose_fix, as wrappers/c/dotpose.h lays it out. */
    bytes: Uint8Array<ArrayBuffer>;
}

/** What a fix has beside its bytes. */
export interface Context {
    status: string;
    message: string;
    code: number;
    dots: Float32Array | null;
}

const kGrid_q16 = 65536;

/** Returns the fix of the bytes, which it keeps. */
export function fixOf(bytes: Uint8Array<ArrayBuffer>, context: Context): Fix {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const int = (offset: number) => view.getInt32(offset, true);
    const natural = (offset: number) => view.getUint32(offset, true);
    const double = (offset: number) => view.getFloat64(offset, true);
    return {
        ok: int(0) === 0,
        status: context.status,
        message: context.message,
        x_mm: double(16),
        y_mm: double(24),
        theta_rad: double(32),
        covariance: Float32Array.from({ length: 9 }, (_, i) => view.getFloat32(48 + 4 * i, true)),
        p_wrong: double(40),
        section: { u: natural(88), v: natural(92) },
        cell: { x: natural(112), y: natural(116) },
        code: kCodes[context.code]!,
        attempt: kAttempts[int(4)]!,
        surface: kSurfaces[int(8)]!,
        spacing_mm: int(108) / 1e6,
        spacing_px: int(132) / kGrid_q16,
        residual_px: view.getFloat32(84, true),
        dots_seen: int(96),
        dots_used: int(100),
        bit_errors: int(104),
        dots: context.dots,
        bytes,
    };
}

/** The map from the image to the paper of a fix: dotpose_plane, in px and spacings. */
interface Plane {
    place: Cell;
    centre: [number, number];
    at_centre: [number, number];
    du: [number, number];
    dv: [number, number];
    perspective: [number, number];
    lens: number;
}

function planeOf(fix: Fix): Plane {
    const view = new DataView(fix.bytes.buffer, fix.bytes.byteOffset);
    const pair = (offset: number, unit: number): [number, number] => [
        view.getInt32(offset, true) / unit,
        view.getInt32(offset + 4, true) / unit,
    ];
    return {
        place: { x: view.getUint32(136, true), y: view.getUint32(140, true) },
        centre: pair(152, 2 ** 8),
        at_centre: pair(160, 2 ** 16),
        du: pair(168, 2 ** 24),
        dv: pair(176, 2 ** 24),
        perspective: pair(184, 2 ** 30),
        lens: view.getInt32(192, true) / 2 ** 40,
    };
}

/** Returns the point of the pattern, in mm, that an image point shows; the fix must be ok. */
export function patternFromImage(fix: Fix, u_px: number, v_px: number): { x_mm: number; y_mm: number } {
    const plane = planeOf(fix);
    const u = u_px - plane.centre[0];
    const v = v_px - plane.centre[1];
    const depth =
        1 + plane.perspective[0] * u + plane.perspective[1] * v + plane.lens * (u * u + v * v);
    const along = (axis: 0 | 1) =>
        plane.at_centre[axis] + (plane.du[axis] * u + plane.dv[axis] * v) / depth;
    return {
        x_mm: (plane.place.x + along(0)) * fix.spacing_mm,
        y_mm: (plane.place.y + along(1)) * fix.spacing_mm,
    };
}

/** Returns the image point, in px, that shows a point of the pattern; the fix must be ok. */
export function imageFromPattern(fix: Fix, x_mm: number, y_mm: number): { u_px: number; v_px: number } {
    const plane = planeOf(fix);
    const x = x_mm / fix.spacing_mm - plane.place.x - plane.at_centre[0];
    const y = y_mm / fix.spacing_mm - plane.place.y - plane.at_centre[1];
    let u = 0;
    let v = 0;
    // Without a lens the first step is exact: x (1 + g u + h v) = a u + b v is linear in u and v. With one,
    // the term that depends on the radius is taken from the step before.
    const kSteps = plane.lens === 0 ? 1 : 12;
    for (let step = 0; step < kSteps; ++step) {
        const depth = 1 + plane.lens * (u * u + v * v);
        const a = plane.du[0] - x * plane.perspective[0];
        const b = plane.dv[0] - x * plane.perspective[1];
        const c = plane.du[1] - y * plane.perspective[0];
        const d = plane.dv[1] - y * plane.perspective[1];
        const determinant = a * d - b * c;
        u = (depth * (x * d - y * b)) / determinant;
        v = (depth * (y * a - x * c)) / determinant;
    }
    return { u_px: plane.centre[0] + u, v_px: plane.centre[1] + v };
}
