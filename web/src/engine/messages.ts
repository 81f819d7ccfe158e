// Messages between the page and the worker: plain data that `postMessage` can send.
import type { Cell, Code, Fix, LocatorOptions, Section } from "dotpose";

/** Intrinsic parameters of a camera. */
export interface PageCamera {
    /**
     * Size of the images. Null if images of any size are accepted. The optical axis then passes through the image
     * centre.
     */
    size_px: readonly [number, number] | null;
    focal_px: readonly [number, number];
    axis_px: readonly [number, number];
    lens_k_per_px2: number;
    /** Distortion centre. */
    centre_px: readonly [number, number];
}

/** Locator options that the page sets. */
export interface ReadOptions extends Pick<LocatorOptions, "code" | "sheets" | "only_sheets"> {
    /** The camera for which the pose in space is computed. It is ignored for images of another size. */
    camera?: PageCamera | null;
}

/** Part of the code that is printed on a page, and the size of the page. */
export interface Sheet {
    code: Code;
    section: Section;
    /** Cell of the first dot. */
    origin: Cell;
    width_mm: number;
    height_mm: number;
}

/** A sheet to be laid out. */
export interface SheetChoice extends Sheet {
    margin_mm: number;
}

/** Layout of a sheet. */
export interface SheetLayout extends Sheet {
    columns: number;
    rows: number;
    /** Position of the first dot's intersection, relative to the upper left corner of the page. */
    first_x_mm: number;
    first_y_mm: number;
}

/** View of the simulated camera: its pose over the sheet, its optics, and the imaging conditions. */
export interface SimulatedView {
    width_px: number;
    height_px: number;
    mm_per_px: number;
    /** Point on the page at the image centre, measured from the upper left corner of the page. */
    x_mm: number;
    y_mm: number;
    theta_rad: number;
    tilt_x_rad: number;
    tilt_y_rad: number;
    paper_level: number;
    vignetting: number;
    blur_px: number;
    noise: number;
    seed: number;
}

/** Symbols of the cells in view, row by row: 0 up, 1 left, 2 right, 3 down. */
export interface CellsInView {
    first: Cell;
    columns: number;
    rows: number;
    symbols: Uint8Array;
}

/** Quality of an image, measured from a sample of its rows. */
export interface ImageQuality {
    /** Mean grey level. */
    brightness: number;
    /** Difference between the 95 % and 0.5 % quantiles of the grey levels. */
    contrast: number;
    /** 98 % quantile of the differences between neighbouring pixels. */
    steepness: number;
    /** `steepness` as a fraction of `contrast`. */
    sharpness: number;
}

/** A frame and its fix. */
export interface Reading {
    fix: Fix;
    picture: ImageBitmap;
    width_px: number;
    height_px: number;
    quality: ImageQuality;
    cells: CellsInView | null;
    /** Duration of the call to the locator. */
    locate_ms: number;
    /** Time of the frame on the clock of its source. */
    time_s: number;
}

/** How the grey levels of a camera frame were read. */
export type LumaPath = "processor" | "canvas";

/** Requests from the page. A request with an `id` gets exactly one answer. */
export type Request =
    | { kind: "layout"; id: number; sheet: SheetChoice }
    | { kind: "symbols"; id: number; sheet: SheetLayout }
    | { kind: "simulate"; id: number; sheet: SheetChoice; view: SimulatedView; options: ReadOptions }
    | { kind: "picture"; id: number; picture: ImageBitmap; time_s: number; options: ReadOptions }
    | { kind: "stream"; frames: ReadableStream<VideoFrame>; options: ReadOptions }
    | { kind: "track"; track: MediaStreamTrack; options: ReadOptions }
    | { kind: "next" }
    | { kind: "stop" };

/** Answers from the worker. A stream sends one `frame` after each `next`. */
export type Answer =
    | { kind: "ready"; processor: boolean }
    | { kind: "result"; id: number; value: unknown }
    | { kind: "failed"; id: number; message: string }
    | { kind: "frame"; reading: Reading; path: LumaPath }
    | { kind: "ended"; message: string };
