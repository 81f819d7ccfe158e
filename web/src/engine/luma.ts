// Reads the grey levels of a frame. Copies them directly from the camera frame if its format allows this. Otherwise,
// draws the frame on a canvas and reads it back.
import type { Image } from "dotpose";
import type { LumaPath } from "./messages.js";

/** Pixel formats whose first plane is the luma, with one byte per pixel. */
const kLumaFirst = new Set(["I420", "I420A", "I422", "I444", "NV12"]);

let canvas: OffscreenCanvas | undefined;
let plane = new Uint8Array(0);

/** Draws a picture and returns its luma, computed with the BT.601 weights that cameras use. */
export function lumaByCanvas(picture: CanvasImageSource, width: number, height: number): Image {
    canvas ??= new OffscreenCanvas(width, height);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const context = canvas.getContext("2d", { willReadFrequently: true })!;
    context.drawImage(picture, 0, 0, width, height);
    const { data } = context.getImageData(0, 0, width, height);
    const luma = new Uint8Array(width * height);
    for (let i = 0, j = 0; i < luma.length; ++i, j += 4)
        luma[i] = (77 * data[j]! + 150 * data[j + 1]! + 29 * data[j + 2]! + 128) >> 8;
    return { data: luma, width, height };
}

/**
 * Returns true if the luma of the frame can be copied directly. The frame must not be rotated or
 * mirrored.
 */
function isPlain(frame: VideoFrame): boolean {
    const { rotation = 0, flip = false } = frame as { rotation?: number; flip?: boolean };
    return frame.format !== null && kLumaFirst.has(frame.format) && rotation === 0 && !flip;
}

/** Returns the luma of a camera frame, and the method by which it was read. */
export async function lumaOfFrame(frame: VideoFrame): Promise<{ image: Image; path: LumaPath }> {
    if (!isPlain(frame)) {
        const image = lumaByCanvas(frame, frame.displayWidth, frame.displayHeight);
        return { image, path: "canvas" };
    }
    const bytes = frame.allocationSize();
    if (plane.length < bytes) plane = new Uint8Array(bytes);
    const layout = await frame.copyTo(plane);
    const { width, height } = frame.visibleRect!;
    const { offset, stride } = layout[0]!;
    return {
        image: { data: plane.subarray(offset, offset + (height - 1) * stride + width), width, height, stride },
        path: "processor",
    };
}
