// What the page and its worker say to each other: plain data, which can be posted.
import type { Cell, Code, Fix, Section } from "dotpose";

/** Where a page lies in the code, and how large it is. */
export interface SheetChoice {
    code: Code;
    section: Section;
    /** Cell of the first dot. */
    origin: Cell;
    width_mm: number;
    height_mm: number;
    margin_mm: number;
}

/** A sheet as it is laid out. */
export interface SheetLayout extends SheetChoice {
    columns: number;
    rows: number;
    /** Place of the first dot's intersection, from the upper left corner of the page. */
    first_x_mm: number;
    first_y_mm: number;
}

/** What the simulated camera sees: its place over the sheet, its optics and what disturbs it. */
export interface SimulatedView {
    width_px: number;
    height_px: number;
    mm_per_px: number;
    /** Point of the page under the image centre, from its upper left corner. */
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

/** How an image looks, read from a sample of its pixels. */
export interface ImageQuality {
    /** Mean grey level. */
    brightness: number;
    /** Grey levels from the darkest to the brightest twentieth. */
    contrast: number;
    /** How steep its steepest edges are: the share of the contrast that two pixels make. */
    sharpness: number;
}

/** One frame, and what was read in it. */
export interface Reading {
    fix: Fix;
    picture: ImageBitmap;
    width_px: number;
    height_px: number;
    quality: ImageQuality;
    cells: CellsInView | null;
    /** Duration of the call of the locator. */
    locate_ms: number;
    /** Of the frame, on the clock of its source. */
    time_s: number;
}

/** How the grey levels of camera frames are had. */
export type LumaPath = "processor" | "canvas";

/** Asked by the page. Those with an `id` get one answer. */
export type Request =
    | { kind: "layout"; id: number; sheet: SheetChoice }
    | { kind: "symbols"; id: number; sheet: SheetLayout }
    | { kind: "simulate"; id: number; sheet: SheetChoice; view: SimulatedView }
    | { kind: "picture"; id: number; picture: ImageBitmap; time_s: number; code: Code | "auto" }
    | { kind: "stream"; frames: ReadableStream<VideoFrame>; code: Code | "auto" }
    | { kind: "track"; track: MediaStreamTrack; code: Code | "auto" }
    | { kind: "next" }
    | { kind: "stop" };

/** Said by the worker. `frame` comes from a stream, after each `next`. */
export type Answer =
    | { kind: "ready"; processor: boolean }
    | { kind: "result"; id: number; value: unknown }
    | { kind: "failed"; id: number; message: string }
    | { kind: "frame"; reading: Reading; path: LumaPath }
    | { kind: "ended"; message: string };
