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
export type { Attempt, Cell, Code, KnownRegion, Prior, Section, Surface } from "./names.js";
export { kDisplacements, patternBits, type PatternPart } from "./pattern.js";
export { WorkerLocator, type Located } from "./worker_locator.js";
