// Poses of the camera in space, fitted by wrappers/c/space/dotpose_space.h.
import { callOk } from "./core.js";
import type { Instance } from "./instance.js";

/** Intrinsic parameters of the camera, as in a camera file of `dotpose calibrate`. */
export interface SpaceCamera {
    /** Focal length in px, from 1 to 1,000,000. */
    focal_px: number;
    /** Pixel on the optical axis, without distortion. Default: the image centre. */
    axis_px?: readonly [number, number];
    /** Printed length divided by the nominal length of the sheet, above 0.1 and below 10. Default: 1. */
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
    /** Angle of the image x axis before the camera leans, clockwise from +x. */
    turn_rad: number;
    /**
     * Covariance of the position, in mm, and of a small rotation vector in the camera frame, in
     * rad: 36 numbers, row by row.
     */
    covariance: Float64Array;
    /** Number of dots used. */
    dots: number;
    /** Root mean square residual of these dots, per axis. */
    residual_px: number;
    /** True if the dots do not exclude the second pose. */
    is_ambiguous: boolean;
    /** The second pose that explains the view. Null if there is none. */
    second: SecondPose | null;
}

/** The second pose that explains the view of a plane. */
export interface SecondPose extends PoseInSpace {
    /** Odds of this pose relative to the first one. */
    odds: number;
}

/** Sizes of the structs, and offsets of their members. */
const kCameraBytes = 80;
const kPoseBytes = 488;
const kCameraAt = { axis_u_px: 32, axis_v_px: 40, lens_k_per_px2: 48, print_scale: 72 };

/** Fits poses in space to the images that a locator located. */
export class SpaceFitter {
    readonly #core: Instance;
    readonly #given: SpaceCamera;
    readonly #lens_k_per_px2: number;
    readonly #camera: number;
    readonly #pose: number;

    /** Throws RangeError for invalid parameters. */
    constructor(core: Instance, given: SpaceCamera, lens_k_per_px2: number) {
        const { focal_px, axis_px = [0, 0], print_scale = 1 } = given;
        // The module cannot throw exceptions, so invalid values must not reach it.
        if (!(focal_px >= 1 && focal_px <= 1e6)) throw new RangeError("focal_px must be from 1 to 1,000,000");
        if (!axis_px.every((px) => Math.abs(px) <= 1e4)) throw new RangeError("axis_px must be within 10,000 px");
        if (!(print_scale > 0.1 && print_scale < 10)) throw new RangeError("print_scale must be from 0.1 to 10");
        this.#core = core;
        this.#given = given;
        this.#lens_k_per_px2 = lens_k_per_px2;
        this.#camera = core.reserve(kCameraBytes);
        this.#pose = core.reserve(kPoseBytes);
    }

    /** Returns the pose of the camera, or null if the dots do not determine it. */
    fit(locator: number, pixels: number, width: number, height: number, stride: number): SpacePose | null {
        const core = this.#core;
        const { focal_px, axis_px, print_scale } = this.#given;
        callOk(core, "dotpose_space_camera_init", this.#camera, kCameraBytes, width, height, focal_px);
        const camera = core.view(this.#camera, kCameraBytes);
        const set = (offset: number, value: number | undefined) => {
            if (value !== undefined) camera.setFloat64(offset, value, true);
        };
        set(kCameraAt.axis_u_px, axis_px?.[0]);
        set(kCameraAt.axis_v_px, axis_px?.[1]);
        set(kCameraAt.lens_k_per_px2, this.#lens_k_per_px2);
        set(kCameraAt.print_scale, print_scale);
        callOk(core, "dotpose_space_pose_init", this.#pose, kPoseBytes);
        const image = [pixels, width, height, stride];
        const status = core.call("dotpose_space_fit", locator, this.#camera, ...image, this.#pose);
        return status === 0 ? poseOf(core.view(this.#pose, kPoseBytes)) : null;
    }
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
