// The messages between the page and its worker. They are plain data, which can be posted.
import type { Cell, Code, Fix, Section } from "dotpose";

/** The part of the code on a page, and the size of the page. */
export interface SheetChoice {
    code: Code;
    section: Section;
    /** Cell of the first dot. */
    origin: Cell;
    width_mm: number;
    height_mm: number;
    margin_mm: number;
}

/** The layout of a sheet. */
export interface SheetLayout extends SheetChoice {
    columns: number;
    rows: number;
    /** Place of the intersection of the first dot, from the upper left corner of the page. */
    first_x_mm: number;
    first_y_mm: number;
}

/** The view of the simulated camera: its pose over the sheet, its optics and the conditions. */
export interface SimulatedView {
    width_px: number;
    height_px: number;
    mm_per_px: number;
    /** Point of the page at the image centre, from the upper left corner of the page. */
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

/** The symbols of the cells in view, row by row: 0 up, 1 left, 2 right, 3 down. */
export interface CellsInView {
    first: Cell;
    columns: number;
    rows: number;
    symbols: Uint8Array;
}

/** The quality of an image, measured on a sample of its pixels. */
export interface ImageQuality {
    /** Mean grey level. */
    brightness: number;
    /** Difference of the 95 % and 5 % quantiles of the grey levels. */
    contrast: number;
    /** 98 % quantile of the steps between neighbouring pixels, as a fraction of the contrast. */
    sharpness: number;
}

/** One frame and its fix. */
export interface Reading {
    fix: Fix;
    picture: ImageBitmap;
    width_px: number;
    height_px: number;
    quality: ImageQuality;
    cells: CellsInView | null;
    /** Duration of the call of the locator. */
    locate_ms: number;
    /** Time of the frame on the clock of its source. */
    time_s: number;
}

/** Method of reading the grey levels of camera frames. */
export type LumaPath = "processor" | "canvas";

/** Requests of the page. A request with an `id` gets one answer. */
export type Request =
    | { kind: "layout"; id: number; sheet: SheetChoice }
    | { kind: "symbols"; id: number; sheet: SheetLayout }
    | { kind: "simulate"; id: number; sheet: SheetChoice; view: SimulatedView }
    | { kind: "picture"; id: number; picture: ImageBitmap; time_s: number; code: Code | "auto" }
    | { kind: "stream"; frames: ReadableStream<VideoFrame>; code: Code | "auto" }
    | { kind: "track"; track: MediaStreamTrack; code: Code | "auto" }
    | { kind: "next" }
    | { kind: "stop" };

/** Answers of the worker. A stream sends a `frame` after each `next`. */
export type Answer =
    | { kind: "ready"; processor: boolean }
    | { kind: "result"; id: number; value: unknown }
    | { kind: "failed"; id: number; message: string }
    | { kind: "frame"; reading: Reading; path: LumaPath }
    | { kind: "ended"; message: string };
