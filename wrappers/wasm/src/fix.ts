// The pose computed from one frame, read from a dotpose_fix (wrappers/c/dotpose.h).
import { fieldsOf, kAt, type FixFields } from "./fix_fields.js";
import { kCodes, type Cell, type Code, type MapUse, type Section } from "./names.js";
import type { SpacePose } from "./space.js";

/**
 * The pose computed from one frame, with its evidence. A Fix is plain data that can be posted
 * between workers.
 *
 * In the pattern frame, x points to the right and y DOWN on the printed page as it is read. The
 * pose is the pattern position at the image centre. If `ok` is false, the pose and covariance are
 * NaN, and only `status`, `message` and `dots_seen` are valid.
 */
export interface Fix extends FixFields {
    /**
     * True if there is a pose. Otherwise, `message` contains the reason. A frame without a pose is
     * not an error.
     */
    ok: boolean;
    /** Identifier of the status, for example "ok" or "too_few_dots". */
    status: string;
    /** Message for the user: one sentence without a full stop. */
    message: string;
    /** Covariance of x, y and theta, in mm and rad: nine numbers, row by row. */
    covariance: Float32Array;
    /** Section to which `cell` belongs. */
    section: Section;
    /** Grid intersection to the upper left of the position (x_mm, y_mm). */
    cell: Cell;
    /** Code variant of the pattern in the frame. */
    code: Code;
    /** Spacing of the printed grid. */
    spacing_mm: number;
    /** Spacing of the grid in the image. */
    spacing_px: number;
    /**
     * Centres of the detected dots: u and v in px from the centre of the first pixel. Null unless
     * the `dots` option is set.
     */
    dots: Float32Array | null;
    /**
     * Pose of the camera in space. Null without the `space` option, or if the dots do not determine
     * the pose.
     */
    space: SpacePose | null;
    /** How the `print_map` option was used. Always "no_map" without the option. */
    map_use: MapUse;
    /** The bytes of this fix as a dotpose_fix (wrappers/c/dotpose.h). */
    bytes: Uint8Array<ArrayBuffer>;
}

/** Properties of a fix that its bytes do not contain. */
export interface Context {
    status: string;
    message: string;
    code: number;
    dots: Float32Array | null;
    map_use: MapUse;
}

const kGrid_q16 = 65536;

/** Returns the fix stored in `bytes`. The fix keeps a reference to `bytes`. */
export function fixOf(bytes: Uint8Array<ArrayBuffer>, context: Context): Fix {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const int = (offset: number) => view.getInt32(offset, true);
    const natural = (offset: number) => view.getUint32(offset, true);
    return {
        ...fieldsOf(view),
        ok: int(kAt.status) === 0,
        status: context.status,
        message: context.message,
        covariance: Float32Array.from({ length: 9 }, (_, i) => view.getFloat32(kAt.covariance + 4 * i, true)),
        section: { u: natural(kAt.section_u), v: natural(kAt.section_v) },
        cell: { x: natural(kAt.cell_x), y: natural(kAt.cell_y) },
        code: kCodes[context.code]!,
        spacing_mm: int(kAt.spacing_nm) / 1e6,
        spacing_px: int(kAt.spacing_px_q16) / kGrid_q16,
        dots: context.dots,
        space: null,
        map_use: context.map_use,
        bytes,
    };
}

/** Map from the image to the paper: a dotpose_plane converted to floating-point px and spacings. */
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
    const place = (offset: number) => view.getUint32(kAt.place + offset, true);
    const int = (offset: number) => view.getInt32(kAt.pattern_from_image + offset, true);
    const pair = (offset: number, unit: number): [number, number] => [int(offset) / unit, int(offset + 4) / unit];
    return {
        place: { x: place(0), y: place(4) },
        centre: pair(0, 2 ** 8),
        at_centre: pair(8, 2 ** 16),
        du: pair(16, 2 ** 24),
        dv: pair(24, 2 ** 24),
        perspective: pair(32, 2 ** 30),
        lens: int(40) / 2 ** 40,
    };
}

/**
 * Returns the pattern point at an image point. Image points are in px from the centre of the first
 * pixel. The fix must be ok.
 */
export function patternFromImage(
    fix: Fix,
    u_px: number,
    v_px: number,
): {
    /** x in the pattern frame, to the right. */
    x_mm: number;
    /** y in the pattern frame, downwards. */
    y_mm: number;
} {
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

/** Returns the image point at which a pattern point appears. The fix must be ok. */
export function imageFromPattern(
    fix: Fix,
    x_mm: number,
    y_mm: number,
): {
    /** Distance from the centre of the first pixel, to the right. */
    u_px: number;
    /** Distance from the centre of the first pixel, downwards. */
    v_px: number;
} {
    const plane = planeOf(fix);
    const x = x_mm / fix.spacing_mm - plane.place.x - plane.at_centre[0];
    const y = y_mm / fix.spacing_mm - plane.place.y - plane.at_centre[1];
    let u = 0;
    let v = 0;
    // Without lens distortion, the first step is exact, because x (1 + g u + h v) = a u + b v is linear in u and v.
    // With distortion, each step uses the radius from the previous step.
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
