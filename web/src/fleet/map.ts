// Shows a live map of the robots. The program sends only the robots that the canvas shows.
import { drawPaper } from "../draw/map.js";
import { surfaceOf, themed } from "../draw/surface.js";
import type { Connection, Value } from "../live/connection.js";
import { element, make, show } from "../page/dom.js";
import { listen } from "../page/gestures.js";
import { MarkPixels } from "./mark_pixels.js";
import { drawNames, drawPath, drawRing, drawRobots, drawScale, drawTrack, drawTrailEnds, drawTrails } from "./marks.js";
import { Positions, trailsOf, type KnownMap, type Robot, type Setup, type Track } from "./messages.js";
import { TrailEnds } from "./trail_ends.js";
import { boundsOf, touches, union, Viewport, type Bounds_mm } from "./viewport.js";

const kAskPeriod_ms = 150;
const kRateSpan_ms = 2000;
/**
 * Time between two updates of the displayed counts. It is long because each update makes the browser lay out part of
 * the page.
 */
const kCountPeriod_ms = 500;
/** Minimum number of robots in view at which their marks are copied as pixels. */
const kMinCopied = 500;
/** Maximum distance between a click and the robot it selects, and maximum movement of the pointer during a click. */
const kNear_px = 24;
const kStill_px = 5;

export class FleetMap {
    readonly #canvas = element("fleet-map", HTMLCanvasElement);
    readonly #maps = element("fleet-maps", HTMLSelectElement);
    readonly #connection: Connection;
    readonly #view = new Viewport();
    /** Background, sheets, trails and scale, which change rarely. */
    readonly #ground = document.createElement("canvas");
    readonly #marks = new MarkPixels();
    #is_ground_old = true;
    #setup: Setup | null = null;
    #known: readonly KnownMap[] = [];
    /** Name of the shown map. Empty until a map is known. */
    #map = "";
    /** True until the user moves the map. */
    #is_fitted = true;
    #fitted: Bounds_mm | null = null;
    #positions: Positions | null = null;
    readonly #trails = new TrailEnds();
    #chosen: Robot | null = null;
    /** Stored tracks of the chosen robot, by map. */
    #tracks: readonly Track[] = [];
    #is_frame_due = false;
    #ask_timer: number | undefined;
    #asked = "";
    #drawn_ms: number[] = [];
    #counted_ms = 0;

    /** `choose` is called with the number of the robot that the user clicks. */
    constructor(connection: Connection, choose: (id: number) => void) {
        this.#connection = connection;
        // Makes the canvas opaque. The browser then need not blend it with the page.
        this.#canvas.getContext("2d", { alpha: false });
        listen(this.#canvas, {
            begin: () => {},
            turn: () => {},
            drag: (dx, dy) => this.#move(() => this.#view.drag(dx, dy)),
            rise: (factor) => this.#move(() => this.#view.zoom(factor)),
        });
        this.#listenToClicks(choose);
        element("fleet-closer", HTMLButtonElement).addEventListener("click", () => this.#move(() => this.#view.zoom(1 / 1.5)));
        element("fleet-farther", HTMLButtonElement).addEventListener("click", () => this.#move(() => this.#view.zoom(1.5)));
        element("fleet-fit", HTMLButtonElement).addEventListener("click", () => this.#fit());
        this.#maps.addEventListener("change", () => this.showMap(this.#maps.value));
        connection.subscribe("positions", (value) => this.#takePositions(value), this.#request());
        connection.subscribe("trails", (value) => this.#takeTrails(value), this.#request());
    }

    setUp(setup: Setup): void {
        this.#setup = setup;
        this.#is_ground_old = true;
        this.#chooseMap();
    }

    takeMaps(maps: readonly KnownMap[]): void {
        this.#known = maps;
        const own = this.#setup?.map ?? "";
        const names = maps.map(({ name }) => name);
        if (own !== "" && !names.includes(own)) names.unshift(own);
        this.#chooseMap();
        if (this.#map !== "" && !names.includes(this.#map)) names.push(this.#map);
        this.#listMaps(names);
        if (this.#is_fitted && this.#hasOutgrown()) this.#fit();
    }

    /** Shows the path of the chosen robot. */
    takeChosen(robot: Robot | null): void {
        this.#chosen = robot;
        this.#requestFrame();
    }

    /** Shows the stored tracks of the chosen robot, and fits the view to the longest track. */
    takeTracks(tracks: readonly Track[]): void {
        this.#tracks = tracks;
        this.#is_ground_old = true;
        this.#requestFrame();
        const points = tracks.map(({ strokes_mm }) => strokes_mm.flat());
        const longest = points.reduce((best, { length }, i) => (length > (points[best]?.length ?? 0) ? i : best), 0);
        const pairs = (points[longest] ?? []).flatMap((x, i, all) => (i % 2 === 0 ? [[x, all[i + 1]!] as const] : []));
        if (pairs.length === 0) return;
        this.showMap(tracks[longest]!.map);
        this.#move(() => this.#view.fit(boundsOf(pairs)));
    }

    showMap(name: string): void {
        if (name === this.#map) return;
        this.#map = name;
        this.#view.y_up = !name.startsWith("pattern");
        this.#positions = null;
        this.#trails.takeTrails(null);
        this.#is_ground_old = true;
        this.#maps.value = name;
        this.#fit();
    }

    showPlace(map: string, x_mm: number, y_mm: number): void {
        this.showMap(map);
        this.#move(() => this.#view.centre(x_mm, y_mm));
    }

    redraw(): void {
        this.#is_ground_old = true;
        if (this.#is_fitted) this.#fit();
        else this.#ask();
        this.#requestFrame();
    }

    #listMaps(names: string[]): void {
        const labels = names.map((name) => {
            const robots = this.#known.find((map) => map.name === name)?.robots ?? 0;
            return [name, `${name} (${robots} robot${robots === 1 ? "" : "s"})`] as const;
        });
        const text = JSON.stringify(labels);
        if (this.#maps.dataset.listed === text) return;
        this.#maps.dataset.listed = text;
        this.#maps.replaceChildren(...labels.map(([value, textContent]) => make("option", { value, textContent })));
        this.#maps.value = this.#map;
    }

    /** Chooses the sheet file's map or, if there is none, the map with the most robots. */
    #chooseMap(): void {
        const name = this.#setup?.map || this.#known[0]?.name;
        if (this.#map === "" && name) this.showMap(name);
    }

    #sheets(): { name: string; corners_mm: readonly (readonly [number, number])[] }[] {
        return this.#setup !== null && this.#setup.map === this.#map ? this.#setup.sheets : [];
    }

    /** Returns the bounds of the robots and of all sheets that touch the robots' bounds. If there are no robots,
     * returns the bounds of all sheets. */
    #content(): Bounds_mm | null {
        const known = this.#known.find(({ name }) => name === this.#map);
        const robots = known ? { x_min: known.x_mm[0], x_max: known.x_mm[1], y_min: known.y_mm[0], y_max: known.y_mm[1] } : null;
        const sheets = this.#sheets().map(({ corners_mm }) => boundsOf(corners_mm));
        return sheets.filter((sheet) => robots === null || touches(sheet, robots)).reduce<Bounds_mm | null>(union, robots);
    }

    /** Returns true if there is content outside the area to which the view was fitted. */
    #hasOutgrown(): boolean {
        const content = this.#content();
        if (content === null || this.#fitted === null) return content !== this.#fitted;
        const all = union(content, this.#fitted)!;
        return all.x_min < this.#fitted.x_min || all.x_max > this.#fitted.x_max || all.y_min < this.#fitted.y_min || all.y_max > this.#fitted.y_max;
    }

    #fit(): void {
        const content = this.#content();
        this.#is_fitted = true;
        this.#measure();
        if (content !== null) {
            // The margin delays the next change of the view when robots drive outwards.
            const margin = 0.03 * Math.max(content.x_max - content.x_min, content.y_max - content.y_min);
            this.#fitted = { x_min: content.x_min - margin, x_max: content.x_max + margin, y_min: content.y_min - margin, y_max: content.y_max + margin };
            this.#view.fit(this.#fitted);
        } else {
            this.#fitted = null;
        }
        this.#changed();
    }

    #move(change: () => void): void {
        this.#is_fitted = false;
        this.#measure();
        change();
        this.#changed();
    }

    #measure(): void {
        Object.assign(this.#view, { width: this.#canvas.clientWidth, height: this.#canvas.clientHeight });
    }

    #changed(): void {
        this.#is_ground_old = true;
        this.#requestFrame();
        this.#ask();
    }

    #request(): Record<string, string | number> {
        return this.#map === "" ? {} : { map: this.#map, ...this.#view.bounds() };
    }

    /** Requests the robots in view, at most once per kAskPeriod_ms. */
    #ask(): void {
        if (this.#ask_timer !== undefined) return;
        this.#ask_timer = window.setTimeout(() => {
            this.#ask_timer = undefined;
            const request = this.#request();
            const text = JSON.stringify(request);
            if (text === this.#asked) return;
            this.#asked = text;
            this.#connection.ask("positions", request);
            this.#connection.ask("trails", request);
        }, kAskPeriod_ms);
    }

    #listenToClicks(choose: (id: number) => void): void {
        let begin: [number, number] | null = null;
        this.#canvas.addEventListener("pointerdown", (event) => (begin = [event.clientX, event.clientY]));
        this.#canvas.addEventListener("pointerup", (event) => {
            if (begin === null || Math.hypot(event.clientX - begin[0], event.clientY - begin[1]) > kStill_px) return;
            const box = this.#canvas.getBoundingClientRect();
            const id = this.#nearest(event.clientX - box.left, event.clientY - box.top);
            if (id !== null) choose(id);
        });
    }

    /** Returns the number of the robot nearest to a point on the canvas, or null if no robot is near. */
    #nearest(x: number, y: number): number | null {
        const positions = this.#positions;
        let [nearest, distance] = [null as number | null, kNear_px];
        for (let i = 0; positions !== null && i < positions.count; ++i) {
            const d = Math.hypot(this.#view.x(positions.x_mm(i)) - x, this.#view.y(positions.y_mm(i)) - y);
            if (d < distance) [nearest, distance] = [positions.id(i), d];
        }
        return nearest;
    }

    async #takePositions(value: Value): Promise<void> {
        const positions = new Positions(value as Uint8Array<ArrayBuffer>);
        if (positions.map === this.#map) {
            const copied = this.#copies();
            this.#positions = positions;
            this.#trails.takePositions(positions);
            if (this.#copies() !== copied) this.#is_ground_old = true;
            this.#requestFrame();
        }
        // Waits until these positions are on the screen before requesting the next positions.
        await new Promise(requestAnimationFrame);
    }

    async #takeTrails(value: Value): Promise<void> {
        const trails = trailsOf(value as Uint8Array<ArrayBuffer>);
        if (trails.map === this.#map) {
            this.#trails.takeTrails(trails);
            this.#is_ground_old = true;
        }
        await new Promise(requestAnimationFrame);
    }

    #requestFrame(): void {
        if (this.#is_frame_due) return;
        this.#is_frame_due = true;
        requestAnimationFrame(() => {
            this.#is_frame_due = false;
            this.#draw();
        });
    }

    #drawGround(): void {
        const { width, height } = this.#canvas;
        if (this.#ground.width !== width || this.#ground.height !== height) Object.assign(this.#ground, { width, height });
        const context = this.#ground.getContext("2d", { alpha: false, willReadFrequently: true })!;
        const scale = width / this.#view.width;
        context.setTransform(scale, 0, 0, scale, 0, 0);
        context.fillStyle = themed("--ground");
        context.fillRect(0, 0, this.#view.width, this.#view.height);
        const shown = this.#view.bounds();
        for (const { name, corners_mm } of this.#sheets().filter((sheet) => touches(boundsOf(sheet.corners_mm), shown))) {
            const corners = corners_mm.map(([x_mm, y_mm]) => ({ x_mm, y_mm }));
            drawPaper(context, { name, corners }, ({ x_mm, y_mm }) => [this.#view.x(x_mm), this.#view.y(y_mm)]);
        }
        if (this.#trails.trails !== null) drawTrails(context, this.#trails.trails, this.#view);
        for (const track of this.#tracks) if (track.map === this.#map) drawTrack(context, track, this.#view);
        if (this.#map !== "") drawScale(context, this.#view);
        if (this.#copies()) this.#marks.setGround(context, scale, this.#positions!.count);
        this.#is_ground_old = false;
    }

    /** Returns true if marks are copied as pixels. With at least `kMinCopied` robots, this is faster than filling
     * paths. */
    #copies(): boolean {
        return (this.#positions?.count ?? 0) >= kMinCopied;
    }

    #draw(): void {
        const { context, width, height } = surfaceOf(this.#canvas);
        Object.assign(this.#view, { width, height });
        if (this.#is_ground_old) this.#drawGround();
        const positions = this.#positions;
        if (positions !== null && this.#copies()) this.#marks.draw(context, positions, this.#view, this.#canvas.width / width);
        else context.drawImage(this.#ground, 0, 0, width, height);
        if (positions !== null) this.#drawAbove(context, positions);
        this.#showCounts();
    }

    #drawAbove(context: CanvasRenderingContext2D, positions: Positions): void {
        if (this.#trails.trails !== null) drawTrailEnds(context, this.#trails, this.#view);
        if (this.#chosen?.map === this.#map) drawPath(context, this.#chosen.path_mm, this.#view);
        if (!this.#copies()) drawRobots(context, positions, this.#view);
        const i = this.#chosen === null ? -1 : positions.indexOf(this.#chosen.id);
        if (i >= 0) drawRing(context, positions.x_mm(i), positions.y_mm(i), this.#view);
        drawNames(context, positions, this.#view);
    }

    /** Shows the number of robots in view, and how often they are drawn. */
    #showCounts(): void {
        const now_ms = performance.now();
        this.#drawn_ms.push(now_ms);
        while (now_ms - this.#drawn_ms[0]! > kRateSpan_ms) this.#drawn_ms.shift();
        if (now_ms - this.#counted_ms < kCountPeriod_ms) return;
        this.#counted_ms = now_ms;
        const rate_hz = ((this.#drawn_ms.length - 1) * 1000) / Math.max(now_ms - this.#drawn_ms[0]!, 1);
        const count = this.#positions?.count ?? 0;
        show({ "fleet-in-view": `${count} in view, drawn ${rate_hz.toFixed(0)} times a second` });
    }
}
