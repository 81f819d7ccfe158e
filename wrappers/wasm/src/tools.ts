// The `dotpose/tools` module: sheets to print, and a simulated camera, compiled from the sources of
// the command-line tool.
import { compile, Instance, type WasmSource } from "./instance.js";
import type { Image } from "./locator.js";
import { pngOf } from "./png.js";
import { sceneFields, sheetFields, type Scene, type SheetOptions } from "./requests.js";

export type { Camera, CameraPose, Imperfections, Scene, SheetOptions } from "./requests.js";
export type { Cell, Code, Section } from "./names.js";
export type { Image } from "./locator.js";

/** Layout of the dots on a sheet. */
export interface SheetLayout {
    /** Number of columns of dots, at least 8. */
    columns: number;
    /** Number of rows of dots, at least 8. */
    rows: number;
    /** Distance of the first intersection from the left edge of the page. */
    origin_x_mm: number;
    /** Distance of the first intersection from the upper edge of the page. */
    origin_y_mm: number;
}

/**
 * A page as pixels, 8 per byte. The leftmost pixel is in the most significant bit. A 1 bit is ink.
 * Each row begins on a byte boundary.
 */
export interface Raster {
    /** Width of the page. */
    width_px: number;
    /** Height of the page. */
    height_px: number;
    /** Resolution in pixels per inch, above 0 and at most 19,200. */
    dpi: number;
    /** The pixels: `height_px` rows of `Math.ceil(width_px / 8)` bytes, from the top. */
    bits: Uint8Array<ArrayBuffer>;
}

const kInch_mm = 25.4;

/**
 * Sheets and a simulated camera.
 *
 *     const tools = await Tools.create();
 *     const png = await tools.png({ width_mm: 100, height_mm: 100 }, 600);
 *     const image = tools.render({ pose: { x_mm: 50, y_mm: 60 }, imperfections: { noise_sigma: 3 } });
 *
 * Invalid requests throw RangeError with a message that names the invalid value.
 */
export class Tools {
    readonly #module: WebAssembly.Module;
    #instance: Instance;

    private constructor(module: WebAssembly.Module, instance: Instance) {
        this.#module = module;
        this.#instance = instance;
    }

    /** Loads the module. `wasm` is required if the module is not next to this file. */
    static async create(wasm?: WasmSource): Promise<Tools> {
        const module = await compile(wasm ?? new URL("./dotpose-tools.wasm", import.meta.url));
        return new Tools(module, await Instance.start(module));
    }

    /**
     * Returns the layout of a sheet. The grid starts at the upper left and contains all whole cells
     * that fit inside the margins.
     */
    layout(sheet: SheetOptions = {}): SheetLayout {
        const kLayoutBytes = 32;
        const address = this.#call("dotpose_tools_layout", sheetFields(sheet));
        const view = this.#instance.view(address, kLayoutBytes);
        const [columns, rows, origin_x_mm, origin_y_mm] = [0, 8, 16, 24].map((at) => view.getFloat64(at, true));
        return { columns: columns!, rows: rows!, origin_x_mm: origin_x_mm!, origin_y_mm: origin_y_mm! };
    }

    /**
     * Returns the centres of all dots, row by row, as x and y in mm from the upper left corner of
     * the page.
     */
    dots(sheet: SheetOptions = {}): Float64Array {
        const { columns, rows } = this.layout(sheet);
        const address = this.#call("dotpose_tools_dots", sheetFields(sheet));
        return new Float64Array(this.#instance.bytes(address, 16 * columns * rows).slice().buffer);
    }

    /**
     * Returns the sheet as SVG. The bytes are the same as in the output of
     * `dotpose print -o sheet.svg`.
     */
    svg(sheet: SheetOptions = {}): string {
        return new TextDecoder().decode(this.#bytes("dotpose_tools_svg", sheetFields(sheet)));
    }

    /**
     * Returns the pixels of the sheet. They are the same as in the output of
     * `dotpose print -o sheet.png`.
     */
    raster(sheet: SheetOptions = {}, dpi = 600): Raster {
        const bits = this.#bytes("dotpose_tools_raster", sheetFields(sheet), dpi);
        const px = (mm: number) => Math.round((mm * dpi) / kInch_mm);
        return { width_px: px(sheet.width_mm ?? 210), height_px: px(sheet.height_mm ?? 297), dpi, bits };
    }

    /**
     * Returns the sheet as a PNG file with 1 bit per pixel. The file contains the resolution, so
     * programs can print the sheet at true size.
     */
    png(sheet: SheetOptions = {}, dpi = 600): Promise<Uint8Array<ArrayBuffer>> {
        return pngOf(this.raster(sheet, dpi));
    }

    /**
     * Returns an image from the simulated camera. The same scene gives the same bytes on every
     * machine.
     */
    render(scene: Scene): Image {
        const { width_px: width = 188, height_px: height = 120 } = scene.camera ?? {};
        return { data: this.#bytes("dotpose_tools_render", sceneFields(scene)), width, height };
    }

    /** Calls a function whose result is a sequence of bytes. */
    #bytes(name: string, fields: number[], ...args: number[]): Uint8Array<ArrayBuffer> {
        const address = this.#call(name, fields, ...args);
        return this.#instance.bytes(address, this.#instance.call("dotpose_tools_size")).slice();
    }

    #call(name: string, fields: number[], ...args: number[]): number {
        if (!fields.every(Number.isFinite)) throw new RangeError("all values must be numbers");
        const request = this.#instance.call("dotpose_tools_request");
        const view = this.#instance.view(request, 8 * fields.length);
        fields.forEach((value, i) => view.setFloat64(8 * i, value, true));
        try {
            return this.#instance.call(name, ...args);
        } catch (trap) {
            const message = this.#instance.text(this.#instance.call("dotpose_tools_error"));
            // A trap interrupts a call and leaves the instance in an undefined state.
            this.#instance = Instance.startNow(this.#module);
            throw message === "" ? trap : new RangeError(message);
        }
    }
}
