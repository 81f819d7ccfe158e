// Poses of the camera in space, fitted by the functions in wrappers/c/space/dotpose_space.h.
import { callOk, callSpace } from "./core.js";
import type { Instance } from "./instance.js";
import type { LocatorOptions } from "./locator.js";
import type { PrintMap } from "./print_map.js";

/** Intrinsic parameters of the camera, as in a camera file written by `dotpose calibrate`. */
export interface SpaceCamera {
    /**
     * Focal length in px, from 1 to 1,000,000. For non-square pixels, give two focal lengths, along
     * the image x and y axes.
     */
    focal_px: number | readonly [number, number];
    /**
     * Point at which the optical axis intersects the undistorted image. Default: the image centre.
     */
    axis_px?: readonly [number, number];
    /**
     * Ratio of a printed length on the sheet to its nominal length, above 0.1 and below 10.
     * Default: 1.
     */
    print_scale?: number;
}

/** A position and a rotation. */
export interface PoseInSpace {
    /**
     * Position of the projection centre in the pattern: x to the right, y DOWN, z INTO the paper. A
     * camera above the paper has z < 0.
     */
    position_mm: [number, number, number];
    /** Rotation from the camera frame to the pattern: unit quaternion x, y, z, w. */
    quaternion_xyzw: [number, number, number, number];
}

/**
 * Pose of the camera in space. In the camera frame, x is to the right and y down in the image, and
 * z is forward along the optical axis.
 */
export interface SpacePose extends PoseInSpace {
    /** Angle between the optical axis and the normal of the paper. */
    tilt_rad: number;
    /** Direction on the paper in which the camera leans, clockwise from +x. */
    azimuth_rad: number;
    /** Angle of the image x axis on the paper after the tilt is removed, clockwise from +x. */
    turn_rad: number;
    /**
     * Covariance of the position (mm) and of a small rotation vector in the camera frame (rad): 36
     * numbers, row by row.
     */
    covariance: Float64Array;
    /** Number of dots used. */
    dots: number;
    /** Root mean square residual of the dots used, per axis. */
    residual_px: number;
    /** True if the dots do not rule out the second pose. */
    is_ambiguous: boolean;
    /** The second pose that explains the view. Null if there is none. */
    second: SecondPose | null;
}

/** The second of the two poses that explain a view of a plane. */
export interface SecondPose extends PoseInSpace {
    /** Odds of this pose relative to the first pose. */
    odds: number;
}

/** Sizes of the structs, and offsets of their members. */
const kCameraBytes = 80;
const kPoseBytes = 488;
const kUseBytes = 4;
const kCameraAt = { focal_u_px: 16, axis_u_px: 32, lens_k_per_px2: 48, lens_centre_u_px: 56, print_scale: 72 };

/** The lens of a camera, as in the locator options. */
export type Lens = Pick<LocatorOptions, "lens_k_per_px2" | "lens_centre_offset_px">;

/** An image in the memory of the module. */
export interface StoredImage {
    pixels: number;
    width: number;
    height: number;
    stride: number;
}

/** Fits poses in space to images that a locator has located. */
export class SpaceFitter {
    readonly #core: Instance;
    readonly #given: SpaceCamera;
    readonly #lens: Lens;
    readonly #camera: number;
    readonly #pose: number;
    readonly #use: number;

    /** Throws RangeError for invalid parameters. */
    constructor(core: Instance, given: SpaceCamera, lens: Lens) {
        const { axis_px = [0, 0], print_scale = 1 } = given;
        if (!focalOf(given).every((px) => px >= 1 && px <= 1e6)) throw new RangeError("focal_px must be from 1 to 1,000,000");
        if (!axis_px.every((px) => Math.abs(px) <= 1e4)) throw new RangeError("axis_px must be within 10,000 px");
        if (!(print_scale > 0.1 && print_scale < 10)) throw new RangeError("print_scale must be between 0.1 and 10");
        this.#core = core;
        this.#given = given;
        this.#lens = lens;
        this.#camera = core.reserve(kCameraBytes);
        this.#pose = core.reserve(kPoseBytes);
        this.#use = core.reserve(kUseBytes);
    }

    /**
     * Returns the pose of the camera, or null if the dots do not determine it. `map` is the print
     * map that corrected the fix of the image, or null.
     */
    fit(locator: number, image: StoredImage, map: PrintMap | null): SpacePose | null {
        const core = this.#core;
        const { pixels, width, height, stride } = image;
        const focal_px = focalOf(this.#given);
        callOk(core, "dotpose_space_camera_init", this.#camera, kCameraBytes, width, height, focal_px[0]);
        const camera = core.view(this.#camera, kCameraBytes);
        const { lens_k_per_px2 = 0, lens_centre_offset_px: offset = [0, 0] } = this.#lens;
        const set = (at: keyof typeof kCameraAt, values: readonly number[]) =>
            values.forEach((value, i) => camera.setFloat64(kCameraAt[at] + 8 * i, value, true));
        set("focal_u_px", focal_px);
        set("axis_u_px", this.#given.axis_px ?? []);
        set("lens_k_per_px2", [lens_k_per_px2]);
        set("lens_centre_u_px", [(width - 1) / 2 + offset[0], (height - 1) / 2 + offset[1]]);
        set("print_scale", [this.#given.print_scale ?? 1]);
        callOk(core, "dotpose_space_pose_init", this.#pose, kPoseBytes);
        const view = [locator, this.#camera, pixels, width, height, stride, this.#pose];
        const status = map
            ? callSpace(core, "dotpose_print_map_fit_space", map.address, ...view, this.#use)
            : callSpace(core, "dotpose_space_fit", ...view);
        return status === 0 ? poseOf(core.view(this.#pose, kPoseBytes)) : null;
    }
}

/** Returns the focal lengths along the image x and y axes. */
function focalOf({ focal_px }: SpaceCamera): readonly [number, number] {
    return typeof focal_px === "number" ? [focal_px, focal_px] : focal_px;
}

/** Reads a dotpose_space_pose. */
function poseOf(view: DataView): SpacePose {
    const int = (offset: number) => view.getInt32(offset, true);
    const double = (offset: number) => view.getFloat64(offset, true);
    const at = (position: number, quaternion: number): PoseInSpace => ({
        position_mm: [double(position), double(position + 8), double(position + 16)],
        quaternion_xyzw: [double(quaternion), double(quaternion + 8), double(quaternion + 16), double(quaternion + 24)],
    });
    return {
        ...at(16, 40),
        tilt_rad: double(72),
        azimuth_rad: double(80),
        turn_rad: double(88),
        covariance: Float64Array.from({ length: 36 }, (_, i) => double(96 + 8 * i)),
        dots: int(4),
        residual_px: double(384),
        is_ambiguous: int(8) !== 0,
        second: int(12) === 0 ? null : { ...at(400, 424), odds: double(392) },
    };
}
