// The "Look" view: locates live frames from a camera of this device.
import type { Code } from "dotpose";
import { drawFrame } from "../draw/frame.js";
import { drawMap, paperOf } from "../draw/map.js";
import type { Engine } from "../engine/engine.js";
import { cornersOf, onPage } from "../engine/field_of_view.js";
import type { LumaPath, Reading, ReadOptions, SheetLayout } from "../engine/messages.js";
import { drawnFrame } from "../engine/overlay.js";
import { announcer, download, element, make, show } from "../page/dom.js";
import { hintOf } from "../page/hints.js";
import type { Point_mm } from "../page/sheet_frame.js";
import type { View } from "../page/view.js";
import type { KnownSheet } from "../print/known_sheets.js";
import { CameraFrames, listCameras, openCamera } from "./camera.js";
import { explain, listenToExplain } from "./explain.js";
import { Log } from "./log.js";
import { Rate } from "./rate.js";
import { showReading } from "./readout.js";
import { SheetControls } from "./sheet_controls.js";
import { SpaceControls } from "./space_controls.js";

const kMaxPathPoints = 3000;

export class LookView implements View {
    readonly #engine: Engine;
    readonly #frame = element("look-frame", HTMLCanvasElement);
    readonly #map = element("look-map", HTMLCanvasElement);
    readonly #start = element("look-start", HTMLButtonElement);
    readonly #freeze = element("look-freeze", HTMLButtonElement);
    readonly #announce = announcer("look-live");
    readonly #log = new Log();
    readonly #rate = new Rate();
    #camera: CameraFrames | undefined;
    #is_opening = false;
    #is_frozen = false;
    /** True if the newest reading is from an opened picture. */
    #is_still = false;
    #last: Reading | undefined;
    #path: Point_mm[] = [];
    readonly #sheets = new SheetControls(() => this.#readAgain(), (text) => this.#say(text));
    readonly #space = new SpaceControls(() => this.#readAgain(), (text) => this.#say(text));
    /** The known sheet that contains the newest fix. */
    #sheet: KnownSheet | null = null;

    constructor(engine: Engine) {
        this.#engine = engine;
        this.#start.addEventListener("click", () => (this.#camera ? this.#stop() : void this.#open("")));
        this.#freeze.addEventListener("click", () => this.#explain());
        listenToExplain(() => this.#thaw());
        element("look-camera", HTMLSelectElement).addEventListener("change", (event) => {
            this.#stop();
            void this.#open((event.target as HTMLSelectElement).value);
        });
        element("look-code", HTMLSelectElement).addEventListener("change", () => this.#readAgain());
        element("look-file", HTMLInputElement).addEventListener("change", (event) => {
            const input = event.target as HTMLInputElement;
            void this.#readFile(input.files?.[0]);
            input.value = "";
        });
        element("look-log", HTMLButtonElement).addEventListener("click", () =>
            download("dotpose-log.csv", "text/csv", this.#log.text()),
        );
        element("look-clear", HTMLButtonElement).addEventListener("click", () => this.#clear());
    }

    shown(): void {
        this.#sheets.refresh();
        this.#sheet = this.#last ? this.#sheets.under(this.#last.fix) : null;
        this.redraw();
    }
    hidden(): void {
        this.#stop();
    }
    redraw(): void {
        if (!this.#last) return;
        drawFrame(this.#frame, drawnFrame(this.#last), { found: true, grid: true, pose: true });
        this.#drawMap(this.#last);
    }

    get #options(): ReadOptions {
        const code = element("look-code", HTMLSelectElement).value as Code | "auto";
        return { code, ...this.#sheets.options, camera: this.#space.camera };
    }

    async #open(device: string): Promise<void> {
        if (this.#is_opening) return;
        this.#is_opening = true;
        try {
            if (!navigator.mediaDevices) throw new Error("cameras need https or localhost");
            const stream = await openCamera(device, this.#space.camera?.size_px ?? [1280, 720]);
            this.#is_still = false;
            this.#camera = new CameraFrames(this.#engine, stream);
            this.#rate.restart();
            this.#camera.start(element("look-video", HTMLVideoElement), this.#options, {
                onFrame: (reading, path) => this.#take(reading, path),
                onEnd: (message) => {
                    this.#stop();
                    this.#say(message);
                },
            });
            this.#start.textContent = "Stop the camera";
            await this.#showCameras(stream.getVideoTracks()[0]!.getSettings().deviceId ?? "");
        } catch (error) {
            this.#say(`No camera: ${error instanceof Error ? error.message : String(error)}.`);
        } finally {
            this.#is_opening = false;
        }
    }

    async #showCameras(used: string): Promise<void> {
        const cameras = await listCameras();
        element("look-cameras", HTMLElement).hidden = cameras.length < 2;
        element("look-camera", HTMLSelectElement).replaceChildren(
            ...cameras.map(({ id, name }) => make("option", { value: id, selected: id === used }, name)),
        );
    }

    #stop(): void {
        this.#camera?.stop();
        this.#camera = undefined;
        this.#is_frozen = false;
        this.#start.textContent = "Start the camera";
        show({ "look-rate": "" });
    }

    async #readFile(file: File | undefined): Promise<void> {
        if (!file) return;
        this.#stop();
        try {
            await this.#readPicture(await createImageBitmap(file));
        } catch {
            this.#say(`This browser cannot read '${file.name}' as a picture.`);
        }
    }

    async #readPicture(picture: ImageBitmap): Promise<void> {
        this.#is_still = true;
        this.#take(await this.#engine.read(picture, this.#options, performance.now() / 1000), null);
    }

    /** Restarts the camera, or reads the opened picture again, after the options have changed. */
    #readAgain(): void {
        if (this.#camera) {
            this.#stop();
            void this.#open(element("look-camera", HTMLSelectElement).value);
        } else if (this.#last && this.#is_still) {
            createImageBitmap(this.#last.picture)
                .then((picture) => this.#readPicture(picture))
                .catch((error: unknown) => this.#say(String(error)));
        }
    }

    #say(text: string): void {
        const box = element("look-hint", HTMLElement);
        box.hidden = text === "";
        box.classList.remove("good");
        show({ "look-hint": text });
        if (text !== "") this.#announce(text);
    }

    /** Shows a reading. `path` is null for a still picture. */
    #take(reading: Reading, path: LumaPath | null): void {
        if (this.#last && this.#last.picture !== reading.picture) this.#last.picture.close();
        this.#last = reading;
        this.#freeze.disabled = false;
        this.#follow(reading);
        this.#log.add(reading, this.#sheet);
        this.redraw();
        showReading(reading, this.#sheet);
        this.#space.showReading(reading);
        this.#showHint(reading);
        this.#showCounts(path);
        if (path !== null && !this.#is_frozen) requestAnimationFrame(() => this.#camera?.next());
    }

    #showCounts(path: LumaPath | null): void {
        if (path !== null) {
            const way = path === "processor" ? "straight from the camera" : "by canvas";
            show({ "look-rate": `${this.#rate.count()} frames per second, ${way}` });
        }
        element("look-log", HTMLButtonElement).disabled = false;
        element("look-clear", HTMLButtonElement).disabled = false;
        show({ "look-logged": `${this.#log.length} ${this.#log.length === 1 ? "frame" : "frames"} logged` });
    }

    /** Adds the position to the path. A position on a different sheet starts a new path. */
    #follow({ fix }: Reading): void {
        if (!fix.ok) return;
        const sheet = this.#sheets.under(fix);
        if (sheet?.name !== this.#sheet?.name) this.#path = [];
        this.#sheet = sheet;
        this.#path.push({ x_mm: fix.x_mm, y_mm: fix.y_mm });
        if (this.#path.length > kMaxPathPoints) this.#path.shift();
    }

    #showHint(reading: Reading): void {
        const complaint = this.#space.complaintOf(reading);
        const hint = complaint ? { text: complaint, good: false } : hintOf(reading, this.#sheets.contextOf(this.#sheet));
        const box = element("look-hint", HTMLElement);
        box.hidden = hint === null;
        box.classList.toggle("good", hint?.good ?? false);
        show({ "look-hint": hint?.text ?? "" });
        this.#announce(hint?.text ?? "The sheet is located.");
    }

    #drawMap({ fix, width_px, height_px }: Reading): void {
        const sheet: SheetLayout | null = this.#sheet?.layout ?? null;
        const path = onPage(sheet, this.#path);
        const view = fix.ok ? onPage(sheet, cornersOf(fix, width_px, height_px)) : [];
        drawMap(this.#map, {
            papers: sheet ? [paperOf(sheet)] : [],
            strokes: [path],
            now: fix.ok ? path.at(-1)! : null,
            heading_rad: null,
            view,
            y_up: false,
        });
        show({ "look-map-name": this.#sheet ? `On the sheet “${this.#sheet.name}”` : "The path" });
    }

    #explain(): void {
        if (!this.#last) return;
        this.#is_frozen = true;
        explain(this.#last);
    }
    #thaw(): void {
        if (!this.#is_frozen) return;
        this.#is_frozen = false;
        this.#rate.restart();
        this.#camera?.next();
    }

    #clear(): void {
        this.#log.clear();
        this.#path = [];
        this.#showCounts(null);
        this.redraw();
    }
}
