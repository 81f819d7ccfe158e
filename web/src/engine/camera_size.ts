// Checks whether the intrinsic parameters of a camera apply to an image.
import type { PageCamera } from "./messages.js";

/** Returns true if the camera could have taken images of this size. */
export function fitsCamera({ size_px }: PageCamera, width_px: number, height_px: number): boolean {
    return size_px === null || (size_px[0] === width_px && size_px[1] === height_px);
}
