// dotpose: computes the pose of a camera from one small frame of a sheet printed with dots.
export { imageFromPattern, patternFromImage, type Fix } from "./fix.js";
export { hasSimd, type WasmSource } from "./instance.js";
export {
    kMaxFrameSide_px,
    kMinFrameSide_px,
    Locator,
    type FrameOptions,
    type Image,
    type LocatorOptions,
} from "./locator.js";
export { type MeasuredMotion } from "./measured_motion.js";
export {
    kAttempts,
    kCodes,
    kMapUses,
    kPriors,
    kSurfaces,
    kTrackEvents,
    kVerdicts,
    type Attempt,
    type Cell,
    type Code,
    type KnownRegion,
    type MapUse,
    type Prior,
    type Section,
    type Surface,
    type TrackEvent,
    type Verdict,
} from "./names.js";
export { kDisplacements, patternBits, type PatternPart } from "./pattern.js";
export { type Prediction } from "./prediction.js";
export { type PoseInSpace, type SecondPose, type SpaceCamera, type SpacePose } from "./space.js";
export { Tracker, type Track, type TrackOptions } from "./tracker.js";
export { WorkerLocator, type Located } from "./worker_locator.js";
