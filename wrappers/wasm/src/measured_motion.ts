// The motion of the camera between two frames, as measured by odometry.

/**
 * Motion of the camera since the previous frame, as measured by wheel odometry or an inertial unit,
 * with its uncertainty. The displacement is along the axes of the previous image. All values must
 * be between -1e6 and 1e6.
 */
export interface MeasuredMotion {
    /** Displacement along the image x axis. Default: 0. */
    right_mm?: number;
    /** Displacement along the image y axis. Default: 0. */
    down_mm?: number;
    /** Change in the `theta_rad` of a fix, clockwise as seen on the paper. Default: 0. */
    turn_rad?: number;
    /**
     * Standard deviation of the displacement along each axis. The errors are assumed to be normally
     * distributed and independent. Values that are too small lead to wrong fixes.
     */
    sigma_mm: number;
    /** Standard deviation of the rotation. */
    sigma_rad: number;
}

/** Size of a dotpose_measured_motion (wrappers/c/dotpose.h), which consists of floats. */
export const kMotionBytes = 20;

/** Writes a dotpose_measured_motion. Throws RangeError if a value is not usable. */
export function writeMotion(motion: MeasuredMotion, view: DataView): void {
    const { right_mm = 0, down_mm = 0, turn_rad = 0, sigma_mm, sigma_rad } = motion;
    const kLimit = 1e6;
    Object.entries({ right_mm, down_mm, turn_rad, sigma_mm, sigma_rad }).forEach(([name, value], i) => {
        const is_sigma = name.startsWith("sigma");
        const is_usable = Math.fround(Math.abs(value)) < kLimit && !(is_sigma && value < 0);
        if (typeof value !== "number" || !is_usable) {
            const range = is_sigma ? "from 0 to below 1e6" : "between -1e6 and 1e6";
            throw new RangeError(`motion.${name} must be ${range}, not ${String(value)}`);
        }
        view.setFloat32(4 * i, value, true);
    });
}
