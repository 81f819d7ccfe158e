// Shows the path of the robot over its sheets.
import { drawMap, type Paper } from "../draw/map.js";
import { element, show } from "../page/dom.js";
import type { Point_mm } from "../page/sheet_frame.js";
import type { Line, Path, Setup } from "./messages.js";

/** Maximum number of positions that are stored until the next path arrives. */
const kMaxRecent = 2000;

function pointsOf(coordinates: readonly number[]): Point_mm[] {
    const points: Point_mm[] = [];
    for (let i = 0; i + 1 < coordinates.length; i += 2) points.push({ x_mm: coordinates[i]!, y_mm: coordinates[i + 1]! });
    return points;
}

export class PathMap {
    readonly #canvas = element("live-map", HTMLCanvasElement);
    #setup: Setup | null = null;
    #strokes: Point_mm[][] = [];
    #visited = new Set<string>();
    /** Positions received after the newest path. The strokes do not contain them. */
    #recent: Point_mm[] = [];
    #sheet: string | null = null;
    #now: Point_mm | null = null;
    #heading_rad: number | null = null;

    setUp(setup: Setup): void {
        this.#setup = setup;
    }

    takePath(path: Path): void {
        this.#strokes = path.strokes_mm.map(pointsOf);
        this.#visited = new Set(path.visited);
        this.#recent = [];
        this.redraw();
    }

    takeLine(line: Line): void {
        this.#now = null;
        if (line.sheet != null) {
            this.#sheet = line.sheet;
            this.#visited.add(line.sheet);
        }
        if (typeof line.track_x_mm === "number") {
            this.#now = { x_mm: line.track_x_mm, y_mm: line.track_y_mm! };
            this.#heading_rad = (line.track_theta_deg! * Math.PI) / 180;
            this.#recent = [...this.#recent.slice(-kMaxRecent), this.#now];
        }
        this.redraw();
    }

    /**
     * Returns the sheets to draw. In the world plane, these are all visited sheets. In the pattern plane, sheets are
     * far apart, so only the current sheet is drawn.
     */
    #papers(): Paper[] {
        const sheets = this.#setup?.sheets ?? [];
        const is_shown = (name: string) => (this.#setup?.plane === "world" ? this.#visited.has(name) : name === this.#sheet);
        return sheets
            .filter(({ name }) => is_shown(name))
            .map(({ name, corners_mm }) => ({ name, corners: corners_mm.map(([x_mm, y_mm]) => ({ x_mm, y_mm })) }));
    }

    redraw(): void {
        const papers = this.#papers();
        const last = this.#strokes.at(-1)?.at(-1);
        const recent = last ? [last, ...this.#recent] : this.#recent;
        drawMap(this.#canvas, {
            papers,
            strokes: [...this.#strokes, this.#now === null ? [] : recent],
            now: this.#now,
            heading_rad: this.#heading_rad,
            view: [],
            y_up: this.#setup?.plane === "world",
        });
        const names = papers.map(({ name }) => name).join(", ");
        show({ "live-map-name": names === "" ? "The path" : `The path over ${names}` });
    }
}
