// The expected position of the pattern in a frame.
import type { Code } from "./names.js";

/**
 * The expected position of the pattern in the next frame, from `Tracker.predict`. A prediction is
 * plain data that can be posted between workers.
 */
export interface Prediction {
    /** Code variant of the predicted pattern. */
    code: Code;
    /** A dotpose_prediction (wrappers/c/dotpose.h). */
    bytes: Uint8Array<ArrayBuffer>;
}

/** Size of a dotpose_prediction. */
export const kPredictionBytes = 76;
