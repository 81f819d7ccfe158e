// Locator: locates the pattern in images.
import { callOk, coreModule } from "./core.js";
import { fixOf, type Fix } from "./fix.js";
import { kAt, kFixBytes } from "./fix_fields.js";
import { Instance, type WasmSource } from "./instance.js";
import { kMotionBytes, writeMotion, type MeasuredMotion } from "./measured_motion.js";
import { codeNumber, type Code, type KnownRegion, type MapUse } from "./names.js";
import { newLocator } from "./new_locator.js";
import { kPredictionBytes, type Prediction } from "./prediction.js";
import { PrintMap } from "./print_map.js";
import { SpaceFitter, type SpaceCamera } from "./space.js";

/** An 8-bit grey image with dark dots on light paper. Row v begins at `data[v * stride]`. */
export interface Image {
    /** Grey levels, row by row. 0 is black. */
    data: Uint8Array | Uint8ClampedArray;
    /** Width in px. */
    width: number;
    /** Height in px. */
    height: number;
    /** Distance between the starts of consecutive rows, in bytes. Default: `width`. */
    stride?: number;
}

/** Options of a locator. The defaults suit any camera. */
export interface LocatorOptions {
    /**
     * Code of the sheets. The default "auto" detects the code from the frames. If the code is
     * ambiguous, frames have the status "ambiguous_code" until further frames given to the same
     * locator resolve the ambiguity.
     */
    code?: Code | "auto";
    /** Spacing of the printed grid. Default: 0.508. */
    spacing_mm?: number;
    /**
     * Radial distortion k of p_u = m + r / (1 + k r^2), per px^2, negative for barrel
     * distortion. Default: 0.
     */
    lens_k_per_px2?: number;
    /**
     * Offset of the distortion centre from the image centre, to the right and down. Default: 0, 0.
     */
    lens_centre_offset_px?: readonly [number, number];
    /**
     * Number of attempts. If 2, a frame that the first attempt cannot locate is filtered and tried
     * again. Default: 2.
     */
    attempts?: 1 | 2;
    /** Maximum probability that a position is wrong. Less certain positions are refused. Default:
     * 1e-9. */
    max_p_wrong?: number;
    /**
     * Minimum number of bits per misread bit, on average over frames of the same print and camera.
     * A known number makes smaller views certain. 0 to 65536. "measured" measures the number over all
     * frames so far. Default: 0, which means unknown.
     */
    bits_per_error?: number | "measured";
    /**
     * Sheets that may be in view. About 30 dots in view, in images of at least 24 x 24 px, are then
     * enough for a fix. Default: none, which makes all places possible.
     */
    sheets?: readonly KnownRegion[];
    /** True if only places on `sheets` are possible. Default: false. */
    only_sheets?: boolean;
    /** True to include the centres of the dots in the fix. This takes more time. Default: false. */
    dots?: boolean;
    /**
     * Intrinsic parameters of the camera. If given, the camera's pose in space is computed for
     * every fix (`Fix.space`). Locating then takes more time and uses a larger module,
     * `dotpose-space.wasm`. The options `lens_k_per_px2` and `lens_centre_offset_px` specify the
     * lens distortion. Default: none.
     */
    space?: SpaceCamera;
    /**
     * Contents of a print map file written by `dotpose calibrate --print-map`. Corrects fixes
     * and poses in space on the pages of the map (`Fix.map_use`). For the highest accuracy, locate
     * without predictions, because tracking measures the dots in windows at their nominal
     * positions. Like `space`, this option makes the locator use the larger module. Default: none.
     */
    print_map?: Uint8Array;
    /** The core module, as a URL, bytes or a compiled module. Default: the file next to this
     * one. */
    wasm?: WasmSource;
}

/** Options for one frame. */
export interface FrameOptions {
    /**
     * Fix of the previous frame, or the prediction of a tracker. Locating then starts at the
     * expected position of the pattern, and is much faster. If the frame does not confirm the
     * prediction, or if the fix is not ok, the frame is located without a prediction.
     */
    prediction?: Fix | Prediction | null | undefined;
    /**
     * Motion of the camera since the previous frame. If a frame alone does not give a certain fix,
     * it is read together with the previous frames. `Fix.frames` is then the number of frames read.
     * Give a motion with every frame of a series, including the first. A frame without a motion
     * ends the series. If the previous frame was located, the search starts at the position
     * predicted from the motion, so a motion replaces a prediction.
     */
    motion?: MeasuredMotion | null | undefined;
}

/** Sizes of structs in wrappers/c/dotpose.h. */
const kDotBytes = 16;
const kRegionBytes = 20;
const kMaxDots = 16384;
const kCountBytes = 4;
const kCodeBytes = 4;

/**
 * Minimum width and height, in px, of an image that can be located. With `sheets`, the minimum is
 * 24.
 */
export const kMinFrameSide_px = 64;
/** Maximum width and height, in px, of an image that can be located. */
export const kMaxFrameSide_px = 4096;

/**
 * Locates the pattern in images.
 *
 *     const locator = await Locator.create({ spacing_mm: 0.508 });
 *     const fix = locator.locate({ data, width, height });
 *     if (fix.ok) console.log(fix.x_mm, fix.y_mm, fix.theta_rad);
 *
 * Each locator has its own memory: 4 MB plus the size of the image. The memory is released with the
 * locator. All engines and the native library give bit-identical results for the same image.
 */
export class Locator {
    readonly #core: Instance;
    readonly #locator: number;
    readonly #fix: number;
    readonly #prediction: number;
    readonly #motion: number;
    readonly #code: number;
    readonly #dots: number;
    readonly #map: PrintMap | null;
    readonly #space: SpaceFitter | null;
    readonly #texts = new Map<number, { status: string; message: string }>();
    #pixels = 0;
    #pixels_bytes = 0;

    private constructor(core: Instance, options: LocatorOptions) {
        this.#core = core;
        this.#fix = core.reserve(kFixBytes);
        callOk(core, "dotpose_fix_init", this.#fix, kFixBytes);
        this.#prediction = core.reserve(kPredictionBytes);
        this.#motion = core.reserve(kMotionBytes);
        this.#code = core.reserve(kCodeBytes);
        this.#dots = options.dots ? core.reserve(kMaxDots * kDotBytes + kCountBytes) : 0;
        this.#locator = newLocator(core, options);
        this.#map = options.print_map ? new PrintMap(core, options.print_map) : null;
        this.#space = options.space ? new SpaceFitter(core, options.space, options) : null;
        if (options.sheets?.length) this.#know(options.sheets, options.only_sheets ?? false);
    }

    /** Creates a locator. Asynchronous, because the first call loads and compiles the module. */
    static async create(options: LocatorOptions = {}): Promise<Locator> {
        const needs_space = options.space !== undefined || options.print_map !== undefined;
        return new Locator(await Instance.start(await coreModule(options.wasm, needs_space)), options);
    }

    /**
     * Returns the fix of an image. Throws RangeError if:
     * - the image has less data than its size requires,
     * - the motion is not usable, or
     * - both a prediction and a motion are given.
     */
    locate(image: Image, options: FrameOptions = {}): Fix {
        const { prediction, motion } = options;
        if (prediction && motion) throw new RangeError("give a prediction or a motion, not both");
        if (motion) writeMotion(motion, this.#core.view(this.#motion, kMotionBytes));
        const stride = this.#write(image);
        const frame = [this.#locator, this.#pixels, image.width, image.height, stride];
        const status = motion
            ? this.#core.call("dotpose_locate_moved", ...frame, this.#motion, this.#fix)
            : this.#core.call("dotpose_locate", ...frame, this.#predict(prediction), this.#fix);
        const map_use = (status === 0 && this.#map?.correct(this.#locator, this.#fix)) || "no_map";
        const fix = this.#read(map_use);
        if (fix.ok && this.#space) {
            const stored = { pixels: this.#pixels, width: image.width, height: image.height, stride };
            fix.space = this.#space.fit(this.#locator, stored, map_use === "used" ? this.#map : null);
        }
        return fix;
    }

    /** Sets the sheets that may be in view. The regions remain in the module's memory, because the
     * core reads them for each frame. */
    #know(sheets: readonly KnownRegion[], only_sheets: boolean): void {
        const regions = this.#core.reserve(sheets.length * kRegionBytes);
        const view = this.#core.view(regions, sheets.length * kRegionBytes);
        sheets.forEach((sheet, i) => {
            const { code = "anoto", section = { u: 0, v: 0 }, first, columns, rows } = sheet;
            const inByte = [codeNumber(code), section.u, section.v];
            const inWord = [first.x, first.y, columns, rows];
            const is = (max: number) => (n: number) => Number.isInteger(n) && n >= 0 && n <= max;
            if (!inByte.every(is(0xff)) || !inWord.every(is(0xffffffff)))
                throw new RangeError(`sheets[${i}] is not a rectangle of the code`);
            inByte.forEach((n, j) => view.setUint8(i * kRegionBytes + j, n));
            inWord.forEach((n, j) => view.setUint32(i * kRegionBytes + 4 * (j + 1), n, true));
        });
        callOk(this.#core, "dotpose_set_known", this.#locator, regions, sheets.length, only_sheets ? 1 : 0);
    }

    /**
     * Copies the pixels into the module's memory, without gaps between rows. Returns the stride
     * of the copy.
     */
    #write({ data, width, height, stride = width }: Image): number {
        if (![width, height, stride].every((n) => Number.isInteger(n) && n >= 0) || stride < width)
            throw new RangeError(`bad image: ${width} x ${height} px with a stride of ${stride}`);
        const needed = height === 0 ? 0 : (height - 1) * stride + width;
        if (data.length < needed)
            throw new RangeError(`the image needs ${needed} bytes, its data has ${data.length}`);
        // Does not copy an image that is too large, because the core refuses it without reading the
        // pixels.
        const is_refused = Math.max(width, height) > kMaxFrameSide_px;
        const pixels = this.#room(is_refused ? 1 : width * height);
        if (is_refused) return stride;
        if (stride === width) pixels.set(data.subarray(0, needed));
        else
            for (let v = 0; v < height; ++v)
                pixels.set(data.subarray(v * stride, v * stride + width), v * width);
        return width;
    }

    /**
     * Returns memory for an image. The memory grows if an image is larger than all previous images.
     */
    #room(bytes: number): Uint8Array<ArrayBuffer> {
        if (bytes > this.#pixels_bytes || this.#pixels === 0) {
            this.#pixels = this.#core.reserve(bytes);
            this.#pixels_bytes = bytes;
        }
        return this.#core.bytes(this.#pixels, bytes);
    }

    /** Returns the address of the prediction, or 0 if there is no usable prediction. */
    #predict(given: Fix | Prediction | null | undefined): number {
        if (!given || codeNumber(given.code) !== this.#codeRead()) return 0;
        if (!("ok" in given)) {
            this.#core.bytes(this.#prediction, kPredictionBytes).set(given.bytes);
        } else {
            if (!given.ok) return 0;
            this.#core.bytes(this.#fix, kFixBytes).set(given.bytes);
            callOk(this.#core, "dotpose_prediction_like", this.#fix, this.#prediction);
        }
        return this.#prediction;
    }

    /**
     * Returns the number of the given code or, for "auto", of the code that was read in the last
     * image.
     */
    #codeRead(): number {
        callOk(this.#core, "dotpose_code_of", this.#locator, this.#code);
        return this.#core.view(this.#code, kCodeBytes).getInt32(0, true);
    }

    #read(map_use: MapUse): Fix {
        const core = this.#core;
        const bytes = core.bytes(this.#fix, kFixBytes).slice();
        const status = core.view(this.#fix, kFixBytes).getInt32(kAt.status, true);
        return fixOf(bytes, {
            ...this.#textsOf(status),
            code: this.#codeRead(),
            dots: this.#dots === 0 ? null : this.#readDots(),
            map_use,
        });
    }

    /**
     * Returns the name and the message of a status. They are cached, because every frame needs
     * them.
     */
    #textsOf(status: number): { status: string; message: string } {
        const text = (name: string) => this.#core.text(this.#core.call(name, status));
        let texts = this.#texts.get(status);
        if (texts === undefined) {
            texts = { status: text("dotpose_status_name"), message: text("dotpose_status_message") };
            this.#texts.set(status, texts);
        }
        return texts;
    }

    #readDots(): Float32Array {
        const count = this.#dots + kMaxDots * kDotBytes;
        this.#core.call("dotpose_dots", this.#locator, this.#dots, kMaxDots, count);
        const found = Math.min(this.#core.view(count, 4).getInt32(0, true), kMaxDots);
        const view = this.#core.view(this.#dots, found * kDotBytes);
        const at = (i: number) => (i >> 1) * kDotBytes + (i & 1) * 4;
        return Float32Array.from({ length: 2 * found }, (_, i) => view.getFloat32(at(i), true));
    }
}
