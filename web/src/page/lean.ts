// Computes the angles of a camera over the paper, with their standard deviations.

export type Quaternion = readonly [x: number, y: number, z: number, w: number];

/** Pose of a camera in the pattern or sheet frame: x right, y DOWN, z INTO the paper. */
export interface SpacePose {
    height_mm: number;
    /** Rotation from the camera frame to the pattern. */
    quaternion_xyzw: Quaternion;
    /**
     * Covariance of the position, in mm, and of a small rotation vector in the CAMERA frame, in rad: 36
     * numbers, row by row.
     */
    covariance: ArrayLike<number>;
}

/** An angle and its standard deviation, in degrees. */
export interface Angle {
    deg: number;
    sigma_deg: number;
}

/** Tilt, azimuth and turn, as defined in docs/pose-in-space.md. */
export interface Lean {
    tilt: Angle;
    azimuth: Angle;
    turn: Angle;
}

/** Returns the rows of the rotation matrix for a quaternion. */
function matrixOf([x, y, z, w]: Quaternion): [number, number, number][] {
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ];
}

/** Returns the standard deviation of the scalar product of `gradient` and the rotation vector. */
function deviation(gradient: number[], covariance: ArrayLike<number>): number {
    let variance = 0;
    gradient.forEach((a, i) => gradient.forEach((b, j) => (variance += a * b * covariance[6 * (3 + i) + 3 + j]!)));
    return Math.sqrt(variance);
}

export function leanOf({ quaternion_xyzw, covariance }: SpacePose): Lean {
    const [x, y, z, w] = quaternion_xyzw;
    const rows = matrixOf(quaternion_xyzw);
    // The optical axis in the pattern. A rotation (a, b, c) in the camera frame moves the axis by b times the first
    // column of the matrix, minus a times the second column.
    const [right, down, into] = rows.map((row) => row[2]) as [number, number, number];
    const [right_by, down_by, into_by] = rows.map((row) => [-row[1], row[0], 0]) as [number[], number[], number[]];
    const aside = Math.hypot(right, down);
    const along = (a: number, da: number[], b: number, db: number[]) => da.map((d, i) => a * d + b * db[i]!);
    const tilt_by =
        aside > 0
            ? along(into / aside, along(right, right_by, down, down_by), -aside, into_by)
            : [Math.SQRT1_2, Math.SQRT1_2, 0];
    const azimuth_by = along(right, down_by, -down, right_by).map((d) => d / aside ** 2);
    const norm = w * w + z * z;
    const turn_by = [(w * -y + z * x) / norm, (w * x + z * y) / norm, 1];
    const angle = (rad: number, gradient: number[]): Angle => ({
        deg: (rad * 180) / Math.PI,
        sigma_deg: (deviation(gradient, covariance) * 180) / Math.PI,
    });
    const turn = 2 * Math.atan2(z, w);
    return {
        tilt: angle(Math.atan2(aside, into), tilt_by),
        azimuth: angle(Math.atan2(-down, -right), azimuth_by),
        turn: angle(Math.atan2(Math.sin(turn), Math.cos(turn)), turn_by),
    };
}

/**
 * Converts a pose in the world to a sheet frame with the same x axis. In the world, y points up, z points OUT of the
 * paper, lengths are in metres, and the covariance is for a rotation vector in the WORLD frame.
 */
export function fromWorld(z_m: number, quaternion_xyzw: Quaternion, covariance: ArrayLike<number>): SpacePose {
    const [x, y, z, w] = quaternion_xyzw;
    // Rotates the axes by 180 degrees about x. The y and z components of the rotation vector therefore change sign.
    const flipped: Quaternion = [w, -z, y, -x];
    const rows = matrixOf(quaternion_xyzw);
    const inCamera = new Float64Array(36);
    const at = (i: number, j: number) => covariance[6 * i + j]!;
    const range = [0, 1, 2];
    for (const i of range)
        for (const j of range) {
            inCamera[6 * i + j] = at(i, j) * 1e6 * (i === 0 ? 1 : -1) * (j === 0 ? 1 : -1);
            for (const k of range)
                for (const l of range) inCamera[6 * (3 + i) + 3 + j]! += rows[k]![i]! * at(3 + k, 3 + l) * rows[l]![j]!;
        }
    return { height_mm: 1000 * z_m, quaternion_xyzw: flipped, covariance: inCamera };
}
