// The "Try" view: locates the frames of a simulated camera over a simulated sheet.
import { drawFrame } from "../draw/frame.js";
import { drawMap, paperOf, type MapFrame } from "../draw/map.js";
import type { Engine } from "../engine/engine.js";
import { cornersOf, onPage } from "../engine/field_of_view.js";
import type { Reading, ReadOptions, SheetChoice, SheetLayout, SimulatedView } from "../engine/messages.js";
import { drawnFrame } from "../engine/overlay.js";
import { announcer, element, show } from "../page/dom.js";
import { degrees, kPriorNames, length, milliseconds, mm, oneIn, wrapped } from "../page/format.js";
import { hintOf } from "../page/hints.js";
import { pageFromPattern, type Point_mm } from "../page/sheet_frame.js";
import type { View } from "../page/view.js";
import { regionOf, sheetUnder, type KnownSheet } from "../print/known_sheets.js";
import { SimulatedCamera, type ImageSize } from "./camera.js";
import { Drive } from "./drive.js";
import { listen } from "../page/gestures.js";
import { buildSliders } from "./sliders.js";

const kSheet: SheetChoice = {
    ...{ code: "anoto", section: { u: 0, v: 0 }, origin: { x: 1000, y: 2000 } },
    ...{ width_mm: 210, height_mm: 297, margin_mm: 5 },
};
const kMaxPathPoints = 600;

/** Image sizes, keyed by the values of the <select> options. The two smallest images show a smaller field of view. */
const kSizes: Record<string, ImageSize> = {
    "188x120": { width_px: 188, height_px: 120, field_px: 188 },
    "376x240": { width_px: 376, height_px: 240, field_px: 188 },
    "640x480": { width_px: 640, height_px: 480, field_px: 188 },
    "66x66": { width_px: 66, height_px: 66, field_px: 66 },
    "36x36": { width_px: 36, height_px: 36, field_px: 66 },
};
/** Distance from the simulated sheet to the other known sheet, in code columns. */
const kOtherColumns = 100_000;
/** Names of the page elements that are empty if a frame has no fix. */
const kFixNames = ["x", "y", "angle", "error", "angle-error", "sheet", "prior", "wrong"];

export class TryView implements View {
    readonly #engine: Engine;
    readonly #camera = new SimulatedCamera();
    readonly #picture = element("try-camera", HTMLCanvasElement);
    readonly #map = element("try-map", HTMLCanvasElement);
    readonly #known = element("try-known", HTMLSelectElement);
    readonly #announce = announcer("try-live");
    readonly #drive: Drive;
    readonly #showSliders: () => void;
    #sheet: SheetLayout | undefined;
    #map_frame: MapFrame | null = null;
    #path: Point_mm[] = [];
    #is_shown = false;
    #is_busy = false;
    #is_stale = false;
    /** The newest frame. It is redrawn when the size or the colour scheme of the window changes. */
    #last: { reading: Reading; view: SimulatedView } | undefined;

    constructor(engine: Engine) {
        this.#engine = engine;
        this.#drive = new Drive(this.#camera, () => this.#changed());
        this.#showSliders = buildSliders(this.#camera, () => this.#changed());
        listen(this.#picture, {
            drag: (dx, dy) => this.#drag(dx, dy),
            turn: (by) => {
                this.#camera.turnBy(by);
                this.#changed();
            },
            rise: (factor) => {
                this.#camera.rise(factor);
                this.#changed();
            },
            begin: () => this.#drive.stop(),
        });
        this.#listenToMap();
        element("try-size", HTMLSelectElement).addEventListener("change", (event) => {
            this.#camera.size = kSizes[(event.target as HTMLSelectElement).value]!;
            this.#changed();
        });
        this.#known.addEventListener("change", () => this.#changed());
    }

    async shown(): Promise<void> {
        this.#is_shown = true;
        this.#sheet ??= await this.#engine.layout(kSheet);
        this.#drive.sheet = this.#sheet;
        this.#drive.resume();
        this.#changed();
    }
    hidden(): void {
        this.#is_shown = false;
        this.#drive.pause();
    }
    redraw(): void {
        if (this.#last) this.#draw(this.#last.reading, this.#last.view);
    }

    #drag(dx: number, dy: number): void {
        const scale = this.#camera.size.width_px / Math.max(1, this.#picture.clientWidth);
        if (this.#sheet) this.#camera.dragBy(dx * scale, dy * scale, this.#sheet);
        this.#changed();
    }

    #listenToMap(): void {
        const move = (event: PointerEvent) => {
            if (event.buttons === 0 || !this.#map_frame || !this.#sheet) return;
            const box = this.#map.getBoundingClientRect();
            const { scale, left_mm, top_mm } = this.#map_frame;
            this.#drive.stop();
            const x_mm = left_mm + (event.clientX - box.left) / scale;
            this.#camera.moveTo(x_mm, top_mm + (event.clientY - box.top) / scale, this.#sheet);
            this.#changed();
        };
        this.#map.addEventListener("pointerdown", (event) => {
            this.#map.setPointerCapture(event.pointerId);
            move(event);
        });
        this.#map.addEventListener("pointermove", move);
    }

    /** Simulates the next frame. Changes made in the meantime take effect after that frame has been drawn. */
    #changed(): void {
        this.#is_stale = true;
        // The tests use this flag to wait until the last change has been drawn.
        this.#picture.dataset["busy"] = "true";
        if (!this.#is_busy) void this.#run();
    }

    /** Returns the sheets that the user has declared as known. */
    #knownSheets(): KnownSheet[] {
        const sheet = this.#sheet!;
        const other = { ...sheet, origin: { ...sheet.origin, x: sheet.origin.x + kOtherColumns } };
        if (this.#known.value === "none") return [];
        if (this.#known.value === "other") return [{ name: "another page", layout: other }];
        return [{ name: "A4 page", layout: sheet }];
    }

    #options(): ReadOptions {
        return {
            code: kSheet.code,
            sheets: this.#knownSheets().map(({ layout }) => regionOf(layout)),
            only_sheets: this.#known.value === "only",
        };
    }

    async #run(): Promise<void> {
        this.#is_busy = true;
        try {
            while (this.#is_stale && this.#is_shown && this.#sheet) {
                this.#is_stale = false;
                const view = this.#camera.view();
                const reading = await this.#engine.simulate(kSheet, view, this.#options());
                this.#last?.reading.picture.close();
                this.#last = { reading, view };
                this.#draw(reading, view);
            }
        } catch (error) {
            const text = error instanceof Error ? error.message : String(error);
            element("try-hint", HTMLElement).hidden = false;
            show({ "try-hint": text });
        } finally {
            this.#is_busy = false;
            this.#picture.dataset["busy"] = "false";
        }
    }

    #draw(reading: Reading, view: SimulatedView): void {
        const frame = drawnFrame(reading);
        drawFrame(this.#picture, frame, {});
        drawFrame(element("try-reading", HTMLCanvasElement), frame, {
            frame: 0.22,
            ...{ found: true, grid: true, symbols: true, pose: true },
        });
        this.#showSliders();
        this.#showHint(reading);
        this.#showReadout(reading, view);
        this.#drawMap(reading, view);
    }

    #drawMap(reading: Reading, view: SimulatedView): void {
        const sheet = this.#sheet!;
        const { fix, width_px, height_px } = reading;
        if (fix.ok) this.#path.push(pageFromPattern(sheet, fix));
        this.#path = this.#path.slice(-kMaxPathPoints);
        this.#map_frame = drawMap(this.#map, {
            papers: [paperOf(sheet)],
            strokes: [this.#path],
            now: { x_mm: view.x_mm, y_mm: view.y_mm },
            heading_rad: null,
            view: fix.ok ? onPage(sheet, cornersOf(fix, width_px, height_px)) : [],
            y_up: false,
        });
    }

    #showHint(reading: Reading): void {
        const sheets = this.#knownSheets();
        const hint = hintOf(reading, {
            is_on_unknown: sheets.length > 0 && sheetUnder(reading.fix, sheets) === null,
            only_sheets: this.#known.value === "only",
        });
        const box = element("try-hint", HTMLElement);
        box.hidden = hint === null;
        box.classList.toggle("good", hint?.good ?? false);
        show({ "try-hint": hint?.text ?? "" });
    }

    #showReadout({ fix, locate_ms }: Reading, view: SimulatedView): void {
        element("try-readout", HTMLElement).classList.toggle("lost", !fix.ok);
        show({ "try-dots": String(fix.ok ? fix.dots_used : fix.dots_seen), "try-time": milliseconds(locate_ms) });
        if (!fix.ok) {
            for (const name of kFixNames) show({ [`try-${name}`]: "–" });
            this.#announce(`No position: ${fix.message}`);
            return;
        }
        const read = pageFromPattern(this.#sheet!, fix);
        const error_mm = Math.hypot(read.x_mm - view.x_mm, read.y_mm - view.y_mm);
        show({
            "try-x": mm(read.x_mm),
            "try-y": mm(read.y_mm),
            "try-angle": degrees(fix.theta_rad),
            "try-error": length(error_mm),
            "try-angle-error": degrees(Math.abs(wrapped(fix.theta_rad - view.theta_rad)), 3),
            "try-sheet": sheetUnder(fix, this.#knownSheets())?.name ?? "not known",
            "try-prior": kPriorNames[fix.prior],
            "try-wrong": oneIn(fix.p_wrong),
        });
        this.#announce(`x ${mm(read.x_mm, 2)}, y ${mm(read.y_mm, 2)}, position error ${length(error_mm)}`);
    }
}
