// Measures the brightness, contrast and sharpness of an image from a sample of its rows.
import type { Image } from "dotpose";
import type { ImageQuality } from "./messages.js";

const kRows = 24;
/** Dots cover at least 1.5 % of the paper, so the darkest 0.5 % of the pixels are in dots. */
const kDarkest = 0.005;
const kBrightest = 0.95;

/** Returns the grey level at the quantile for `probability` of a histogram with `count` pixels. */
function quantile(histogram: Uint32Array, count: number, probability: number): number {
    let below = 0;
    for (let level = 0; level < 256; ++level) {
        below += histogram[level]!;
        if (below > probability * count) return level;
    }
    return 255;
}

/** Measures an image. Takes much less than a millisecond for images of any size. */
export function measureQuality({ data, width, height, stride = width }: Image): ImageQuality {
    const levels = new Uint32Array(256);
    const steps = new Uint32Array(256);
    const rows = Math.min(kRows, height);
    for (let i = 0; i < rows; ++i) {
        const start = Math.floor(((i + 0.5) * height) / rows) * stride;
        for (let u = 0; u < width; ++u) {
            const level = data[start + u]!;
            levels[level]! += 1;
            if (u > 0) steps[Math.abs(level - data[start + u - 1]!)]! += 1;
        }
    }
    const count = rows * width;
    const contrast = quantile(levels, count, kBrightest) - quantile(levels, count, kDarkest);
    let sum = 0;
    levels.forEach((n, level) => (sum += n * level));
    const kSteepest = 0.98;
    const steepness = quantile(steps, count, kSteepest);
    return {
        brightness: sum / count,
        contrast,
        steepness,
        sharpness: contrast === 0 ? 0 : steepness / contrast,
    };
}
