// Value of the `calibration` topic (docs/web.md). apps/dotpose-live/web_calibration.cpp writes it.

export type StepName = "lens" | "spin" | "drive" | "readout" | "pivot";
export type Phase = "idle" | "collecting" | "solving" | "solved" | "failed" | "saved";

/** Progress towards one goal. */
export interface Gauge {
    label: string;
    text: string;
    /** Fraction of the goal that has been reached, at most 1. */
    fraction: number;
    is_reached: boolean;
}

/** Parts of the image, directions and tilts covered by the frames accepted for the lens calibration. */
export interface LensCoverage {
    columns: number;
    /** A digit for each part of the image, row by row: 1 if dots have been seen in this part, otherwise 0. */
    covered: string;
    directions: boolean[];
    /** Direction of the newest frame. Null if the frame was not located. */
    theta_rad: number | null;
    /** For each frame, the change of the scale from the middle of the image to a corner, along u and v. */
    tilts: [number, number][];
    needs: string[];
    remark: string;
    is_taken: boolean;
}

/** Mean residual in each part of the image, in px, as alternating u and v, row by row. */
export interface Residuals {
    columns: number;
    rows: number;
    before: number[];
    after: number[];
}

/**
 * Pose of the camera in one frame, relative to the centre of rotation. The offset is the centre computed from this
 * frame alone minus the centre computed from all frames.
 */
export type Station = [x_mm: number, y_mm: number, theta_rad: number, off_x_mm: number, off_y_mm: number];

export interface Result {
    /** Rows of the report, as pairs of a label and its text. */
    rows: [string, string][];
    is_good: boolean;
    /** Improvements that could be achieved with more frames. */
    improvements: string[];
    residuals: Residuals | null;
    stations_mm: Station[];
}

export interface CalibrationState {
    /**
     * Name of the camera file. If the program is not permitted to calibrate, `CalibrationValue` contains null instead.
     */
    file: string;
    step: StepName;
    phase: Phase;
    frames: number;
    gauges: Gauge[];
    advice: string;
    lens: LensCoverage | null;
    /**
     * True for each direction seen so far: headings of a robot during a turn, or directions in which a pen was tilted.
     */
    directions: boolean[];
    /** Tilts of a pen. The components are tangents, to the right and down on the sheet. */
    leans: [number, number][];
    /** In a step with a moving robot or pen, the requirements that have not been met yet. */
    needs: string[];
    problem: string;
    result: Result | null;
    /**
     * For each step, the result that the camera file contains, as text. Empty if the file does not contain a result.
     */
    values: Record<StepName, string>;
}

export type CalibrationValue = CalibrationState | { file: null };
