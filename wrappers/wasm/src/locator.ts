// Locator: finds where the pattern is seen in an image.
import { coreModule } from "./core.js";
import { fixOf, type Fix } from "./fix.js";
import { kAt, kFixBytes } from "./fix_fields.js";
import { Instance, type WasmSource } from "./instance.js";
import { codeNumber, type Code } from "./names.js";

/** An 8-bit grey image, dark dots on light paper; row v begins at `data[v * stride]`. */
export interface Image {
    data: Uint8Array | Uint8ClampedArray;
    width: number;
    height: number;
    /** Bytes from one row to the next; default: `width`. */
    stride?: number;
}

/** Options of a locator; the defaults suit any camera. */
export interface LocatorOptions {
    /**
     * Table of the code that the sheets are printed with; default "auto": the frames show it. What one frame
     * leaves open, others of the same locator decide; until then it has the status "ambiguous_code".
     */
    code?: Code | "auto";
    /** Spacing of the printed grid; default 0.508. */
    spacing_mm?: number;
    /** Radial distortion k of p_u = m + r / (1 + k r^2), per px^2, negative for barrels; default 0. */
    lens_k_per_px2?: number;
    /** Number of attempts: 2 reads a frame again, filtered, that could not be read; default 2. */
    attempts?: 1 | 2;
    /** Greatest probability of being wrong with which a position is given; default 1e-9. */
    max_p_wrong?: number;
    /** Whether a fix has the centres of its dots, which takes time; default false. */
    dots?: boolean;
    /** The module of the core, if it does not lie beside this file: URL, bytes or module. */
    wasm?: WasmSource;
}

/** Options of one frame. */
export interface FrameOptions {
    /**
     * The fix of the frame before: the pattern is first looked for where it was, which takes a fraction of
     * the time. A frame that does not bear it out, or a fix that is not ok, costs nothing but time.
     */
    prediction?: Fix | null | undefined;
}

/** Places in a dotpose_options of wrappers/c/dotpose.h. */
const kOptionsBytes = 96;
const kOptionOffsets = { code: 4, effort: 8, show_stages: 88 };
const kDoubleOffsets = { spacing_mm: 16, lens_k_per_px2: 24, max_p_wrong: 64 };
/** Sizes of the other structs of that header. */
const kPredictionBytes = 72;
const kEvidenceBytes = 36;
const kReadingBytes = 28;
const kDotBytes = 16;
const kMaxDots = 16384;
const kPointerBytes = 4;

/** Least and greatest width and height of an image. */
export const kMinFrameSide_px = 64;
export const kMaxFrameSide_px = 4096;

/**
 * Finds where the pattern is seen in an image.
 *
 *     const locator = await Locator.create({ spacing_mm: 0.508 });
 *     const fix = locator.locate({ data, width, height });
 *     if (fix.ok) console.log(fix.x_mm, fix.y_mm, fix.theta_rad);
 *
 * Each locator has a memory of its own, of 4 MB and the image, which goes with it. The same image gives the
 * same bits in every engine, and natively.
 */
export class Locator {
    readonly #core: Instance;
    readonly #locator: number;
    readonly #fix: number;
    readonly #prediction: number;
    /** Of all frames so far; 0 if the code is given. */
    readonly #evidence: number;
    readonly #reading: number;
    readonly #dots: number;
    /** Number of the code that is given, or was read last. */
    #code: number;
    readonly #texts = new Map<number, { status: string; message: string }>();
    #pixels = 0;
    #pixels_bytes = 0;

    private constructor(core: Instance, options: LocatorOptions) {
        this.#core = core;
        this.#fix = core.reserve(kFixBytes);
        this.#require(core.call("dotpose_fix_init", this.#fix, kFixBytes));
        this.#prediction = core.reserve(kPredictionBytes);
        const { code = "auto" } = options;
        this.#code = code === "auto" ? 0 : codeNumber(code);
        this.#evidence = code === "auto" ? core.reserve(kEvidenceBytes) : 0;
        this.#reading = core.reserve(kReadingBytes);
        this.#dots = options.dots ? core.reserve(kMaxDots * kDotBytes + kPointerBytes) : 0;
        this.#locator = this.#init(options);
    }

    /** Makes a locator; asynchronous because the module is loaded and compiled for the first one. */
    static async create(options: LocatorOptions = {}): Promise<Locator> {
        return new Locator(await Instance.start(await coreModule(options.wasm)), options);
    }

    /** Returns the pose that an image shows. Throws RangeError if the image has less data than it says. */
    locate(image: Image, options: FrameOptions = {}): Fix {
        const stride = this.#write(image);
        const prediction = this.#predict(options.prediction);
        const frame = [this.#locator, this.#pixels, image.width, image.height, stride, prediction];
        if (this.#evidence === 0) {
            this.#core.call("dotpose_locate", ...frame, this.#fix);
        } else {
            this.#core.call("dotpose_locate_any_code", ...frame, this.#evidence, this.#reading, this.#fix);
            this.#code = this.#core.view(this.#reading, kReadingBytes).getInt32(0, true);
        }
        return this.#read();
    }

    #init(options: LocatorOptions): number {
        const { attempts = 2 } = options;
        if (attempts !== 1 && attempts !== 2) throw new RangeError(`attempts are 1 or 2, not ${String(attempts)}`);
        const core = this.#core;
        const given = core.reserve(kOptionsBytes);
        this.#require(core.call("dotpose_options_init", given, kOptionsBytes));
        const view = core.view(given, kOptionsBytes);
        const set = (name: keyof typeof kOptionOffsets, value: number) =>
            view.setInt32(kOptionOffsets[name], value, true);
        set("code", this.#code);
        set("show_stages", options.dots ? 1 : 0);
        set("effort", attempts);
        for (const name of Object.keys(kDoubleOffsets) as (keyof typeof kDoubleOffsets)[]) {
            const value = options[name];
            if (value !== undefined) view.setFloat64(kDoubleOffsets[name], value, true);
        }
        const bytes = core.call("dotpose_large_bytes");
        const memory = core.reserve(bytes);
        const pointer = core.reserve(kPointerBytes);
        this.#require(core.call("dotpose_large_init", memory, bytes, given, pointer));
        return core.view(pointer, kPointerBytes).getUint32(0, true);
    }

    /** Throws the message of a status that only a wrong option or argument can have. */
    #require(status: number): void {
        if (status !== 0) throw new RangeError(this.#core.text(this.#core.call("dotpose_status_message", status)));
    }

    /** Copies the pixels into the module's memory, without gaps between rows; returns their stride. */
    #write({ data, width, height, stride = width }: Image): number {
        if (![width, height, stride].every((n) => Number.isInteger(n) && n >= 0) || stride < width)
            throw new RangeError(`bad image: ${width} x ${height} px with a stride of ${stride}`);
        const needed = height === 0 ? 0 : (height - 1) * stride + width;
        if (data.length < needed)
            throw new RangeError(`the image needs ${needed} bytes, its data has ${data.length}`);
        // Sizes that the core refuses are not copied: it looks at no pixel, only for an address.
        const is_refused = Math.max(width, height) > kMaxFrameSide_px;
        const pixels = this.#room(is_refused ? 1 : width * height);
        if (is_refused) return stride;
        if (stride === width) pixels.set(data.subarray(0, needed));
        else
            for (let v = 0; v < height; ++v)
                pixels.set(data.subarray(v * stride, v * stride + width), v * width);
        return width;
    }

    /** Returns memory for an image; it grows with the largest one. */
    #room(bytes: number): Uint8Array<ArrayBuffer> {
        if (bytes > this.#pixels_bytes || this.#pixels === 0) {
            this.#pixels = this.#core.reserve(bytes);
            this.#pixels_bytes = bytes;
        }
        return this.#core.bytes(this.#pixels, bytes);
    }

    /** Returns the address of the prediction that the frame looks like that of the fix; 0 for none. */
    #predict(fix: Fix | null | undefined): number {
        if (!fix?.ok || codeNumber(fix.code) !== this.#code) return 0;
        this.#core.bytes(this.#fix, kFixBytes).set(fix.bytes);
        this.#require(this.#core.call("dotpose_prediction_like", this.#fix, this.#prediction));
        return this.#prediction;
    }

    #read(): Fix {
        const core = this.#core;
        const bytes = core.bytes(this.#fix, kFixBytes).slice();
        const status = core.view(this.#fix, kFixBytes).getInt32(kAt.status, true);
        return fixOf(bytes, {
            ...this.#textsOf(status),
            code: this.#code,
            dots: this.#dots === 0 ? null : this.#readDots(),
        });
    }

    /** Returns the name and the sentence of a status; read once, since each frame has one. */
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
