// Shows the stored history of the chosen robot: its track on the map, and its speed and states over time.
import { surfaceOf, themed } from "../draw/surface.js";
import type { Connection, Request } from "../live/connection.js";
import { element, show } from "../page/dom.js";
import type { StoredHistory, Track } from "./messages.js";

const kMotions = ["moving", "still", "lost"] as const;
const kInk = { moving: "--accent", still: "--good", lost: "--lost" } as const;
const kHour_s = 3600;
const kSpans_s: Record<string, number> = { hour: kHour_s, day: 24 * kHour_s, week: 7 * 24 * kHour_s };

function timeText(time_us: number): string {
    return new Date(time_us / 1000).toLocaleString("en-GB");
}

/** Returns the percentage of states in which the robot had this motion, as text. */
function shareText(motion: string, count: number, states: number): string {
    return `${((100 * count) / states).toFixed(count === 0 || count === states ? 0 : 1)} % ${motion}`;
}

/** Returns the maximum time between consecutive states. A longer gap is treated as a pause. */
function maxGap_ms(span_ms: number): number {
    const kMaxGap_ms = 2000;
    return Math.max(kMaxGap_ms, 3 * span_ms);
}

/**
 * Returns one track for each map in a history. A track begins a new stroke after a pause, and when the robot returns
 * after being lost or on another map.
 */
export function tracksOf({ maps, map_of, x_mm, y_mm, times_ms, span_ms }: StoredHistory): Track[] {
    const tracks = maps.map((map): Track => ({ map, strokes_mm: [] }));
    let before = -1;
    for (let i = 0; i < times_ms.length; ++i) {
        const map = map_of[i] ?? null;
        if (map === null) continue;
        const { strokes_mm } = tracks[map]!;
        const is_next = before === i - 1 && map_of[before] === map && times_ms[i]! - times_ms[before]! <= maxGap_ms(span_ms);
        if (!is_next) strokes_mm.push([]);
        strokes_mm.at(-1)!.push(x_mm[i]!, y_mm[i]!);
        before = i;
    }
    return tracks;
}

export class HistoryPanel {
    readonly #connection: Connection;
    readonly #shown: (tracks: readonly Track[]) => void;
    readonly #panel = element("fleet-stored", HTMLElement);
    readonly #span = element("fleet-stored-span", HTMLSelectElement);
    readonly #from = element("fleet-stored-from", HTMLInputElement);
    readonly #to = element("fleet-stored-to", HTMLInputElement);
    readonly #canvas = element("fleet-stored-graph", HTMLCanvasElement);
    #robot = "";
    /** Number of the newest request. Answers to earlier requests are not shown. */
    #ask = 0;
    #history: StoredHistory | null = null;

    /** `shown` is called with the tracks to draw on the map. */
    constructor(connection: Connection, shown: (tracks: readonly Track[]) => void) {
        this.#connection = connection;
        this.#shown = shown;
        this.#span.addEventListener("change", () => this.#chooseSpan());
        element("fleet-stored-form", HTMLFormElement).addEventListener("submit", (event) => {
            event.preventDefault();
            this.#request();
        });
        element("fleet-stored-hide", HTMLButtonElement).addEventListener("click", () => this.#clear());
    }

    /** Shows the panel if the program stores the states. */
    enable(has_history: boolean): void {
        this.#panel.hidden = !has_history;
        if (has_history) this.#connection.subscribe("history", (value) => this.#take(JSON.parse(value as string) as StoredHistory | null));
    }

    /** Chooses a robot. `name` is empty if no robot is chosen. */
    choose(name: string): void {
        if (name === this.#robot) return;
        this.#robot = name;
        this.#clear();
    }

    redraw(): void {
        if (this.#history !== null) this.#draw(this.#history);
    }

    #chooseSpan(): void {
        const is_free = this.#span.value === "free";
        element("fleet-stored-times", HTMLElement).hidden = !is_free;
        this.#from.required = this.#to.required = is_free;
    }

    #request(): void {
        const request: Request = { robot: this.#robot, ask: ++this.#ask };
        const last_s = kSpans_s[this.#span.value];
        if (last_s !== undefined) Object.assign(request, { last_s });
        else Object.assign(request, { from_s: Date.parse(this.#from.value) / 1000, to_s: Date.parse(this.#to.value) / 1000 });
        this.#connection.ask("history", request);
        show({ "fleet-stored-text": "reading the database" });
    }

    #clear(): void {
        this.#history = null;
        ++this.#ask;
        this.#connection.ask("history", {});
        show({ "fleet-stored-text": "" });
        this.#setShown(false);
        this.#shown([]);
    }

    #setShown(is_shown: boolean): void {
        element("fleet-stored-figure", HTMLElement).hidden = !is_shown;
        element("fleet-stored-hide", HTMLElement).hidden = !is_shown;
    }

    #take(history: StoredHistory | null): void {
        if (history === null || history.ask !== this.#ask || history.is_reading || this.#history?.ask === this.#ask) return;
        const has_states = history.problem === undefined && history.states > 0;
        show({ "fleet-stored-text": history.problem ?? this.#text(history) });
        this.#history = has_states ? history : null;
        this.#setShown(has_states);
        if (has_states) this.#draw(history);
        this.#shown(has_states ? tracksOf(history) : []);
    }

    #text({ states, times_ms, first_us, last_us, counts, max_speed_mm_s, is_cut }: StoredHistory): string {
        if (states === 0) return "There are no states in this time.";
        const thinned = times_ms.length < states ? `, of which ${times_ms.length} are shown` : "";
        const shares = kMotions.map((motion) => shareText(motion, counts[motion], states)).join(", ");
        const cut = is_cut ? " The span has more states: choose a shorter one." : "";
        return `${states} states from ${timeText(first_us)} to ${timeText(last_us)}${thinned}: ${shares}; up to ${max_speed_mm_s.toFixed(0)} mm/s.${cut}`;
    }

    /** Draws the speed, with the states below it. */
    #draw({ times_ms, speeds_mm_s, motions, span_ms, max_speed_mm_s }: StoredHistory): void {
        const kBand_px = 12;
        const { context, width, height } = surfaceOf(this.#canvas);
        const [ground, top] = [height - kBand_px - 4, 16];
        const per_ms = width / (times_ms.at(-1)! + span_ms);
        const per_mm_s = (ground - top) / Math.max(max_speed_mm_s, 1);
        times_ms.forEach((time_ms, i) => {
            // A bar extends to the next state, except before a pause.
            const gap_ms = (times_ms[i + 1] ?? Infinity) - time_ms;
            const length_ms = gap_ms <= maxGap_ms(span_ms) ? gap_ms : span_ms;
            const x = Math.floor(time_ms * per_ms);
            const columns = Math.ceil((time_ms + length_ms) * per_ms) - x;
            context.fillStyle = themed("--accent");
            const bar = speeds_mm_s[i]! * per_mm_s;
            context.fillRect(x, ground - bar, columns, bar);
            context.fillStyle = themed(kInk[kMotions[motions[i]!]!]);
            context.fillRect(x, height - kBand_px, columns, kBand_px);
        });
        context.fillStyle = themed("--line");
        context.fillRect(0, ground, width, 1);
        context.fillStyle = themed("--text");
        context.font = "600 12px system-ui, sans-serif";
        context.textBaseline = "top";
        context.fillText(`${max_speed_mm_s.toFixed(0)} mm/s`, 0, 0);
    }
}
