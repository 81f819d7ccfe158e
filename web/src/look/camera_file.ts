// Reads the camera files that `dotpose calibrate` writes (docs/calibration.md), but only the values needed for a pose
// in space.
import type { PageCamera } from "../engine/messages.js";

type Values = Map<string, string>;

/** Returns the values of the top-level keys, without comments. */
function valuesOf(text: string): Values {
    const values: Values = new Map();
    for (const line of text.split(/\r?\n/)) {
        const [, key, value] = /^([A-Za-z_]\w*):\s*(.*?)\s*(?:#.*)?$/.exec(line) ?? [];
        if (key !== undefined) values.set(key, value!);
    }
    return values;
}

function numbers(values: Values, key: string, count: number): number[] {
    const text = values.get(key);
    if (text === undefined) throw new Error(`it has no ${key}`);
    const parts = text.replace(/^\[(.*)\]$/, "$1").split(",").map((part) => (part.trim() === "" ? NaN : Number(part)));
    if (parts.length !== count || !parts.every(Number.isFinite))
        throw new Error(`its ${key} is '${text}'; it must be ${count === 1 ? "a number" : `${count} numbers`}`);
    return parts;
}

/** Returns the focal lengths and the optical axis. */
function pinholeOf(values: Values, centre_px: [number, number]): Pick<PageCamera, "focal_px" | "axis_px"> {
    if (values.has("pinhole_px")) {
        const [fu, fv, u, v] = numbers(values, "pinhole_px", 4) as [number, number, number, number];
        return { focal_px: [fu, fv], axis_px: [u, v] };
    }
    if (!values.has("focal_px"))
        throw new Error("it has no focal_px: calibrate with frames in which the camera is tilted by 10 to 30 degrees");
    const [focal] = numbers(values, "focal_px", 1) as [number];
    return { focal_px: [focal, focal], axis_px: centre_px };
}

/** Returns the camera described by a camera file. Throws an Error with the reason if the page cannot use the file. */
export function cameraOfFile(text: string): PageCamera {
    const values = valuesOf(text);
    if (values.has("camera_matrix") || values.has("distortion_model"))
        throw new Error("it is a file of ROS: make a camera file with dotpose calibrate, or enter the focal length");
    if (values.get("format") !== "dotpose-camera") throw new Error('its "format" is not "dotpose-camera"');
    if (values.get("version") !== "1") throw new Error(`its version is ${values.get("version")}; this page reads version 1`);
    if (values.get("flip") === "true") throw new Error("its frames are mirrored, which this page does not correct");
    const centre_px = numbers(values, "centre_px", 2) as [number, number];
    const size_px: [number, number] = [numbers(values, "width_px", 1)[0]!, numbers(values, "height_px", 1)[0]!];
    const [k] = numbers(values, "k_per_px2", 1) as [number];
    const camera = { size_px, lens_k_per_px2: k, centre_px, ...pinholeOf(values, centre_px) };
    requireReal(camera);
    return camera;
}

/** Throws an Error if a value is out of range. The ranges are the same as in the command-line tool. */
function requireReal({ size_px, focal_px, axis_px, lens_k_per_px2, centre_px }: PageCamera & { size_px: [number, number] }): void {
    const kMaxFocal_px = 1e6;
    const kMaxCentre_px = 1000;
    const [width, height] = size_px;
    const isNear = ([u, v]: readonly [number, number]) =>
        Math.abs(u - (width - 1) / 2) <= kMaxCentre_px && Math.abs(v - (height - 1) / 2) <= kMaxCentre_px;
    if (!focal_px.every((px) => px >= 1 && px <= kMaxFocal_px)) throw new Error("its focal length must be from 1 to 1,000,000 px");
    if (!isNear(axis_px) || !isNear(centre_px)) throw new Error("its centre is more than 1000 px off the image centre");
    for (const u of [0, width - 1])
        for (const v of [0, height - 1]) {
            const stretch = 1 + lens_k_per_px2 * ((u - centre_px[0]) ** 2 + (v - centre_px[1]) ** 2);
            if (!(stretch >= 0.5 && stretch <= 2)) throw new Error(`its k_per_px2 folds an image of ${width} x ${height} px`);
        }
}
