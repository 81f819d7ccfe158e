// Values of the topics that `dotpose fleet --web` publishes (docs/fleet.md). apps/dotpose-live/fleet_values.cpp and
// fleet_map_values.cpp write them.

type Pair = readonly [number, number];

export const kConditions = ["moving", "still", "lost", "silent", "gone"] as const;
export type Condition = (typeof kConditions)[number];

export interface Setup {
    /** Name of the only robot if the page is served by `dotpose listen`. Empty if the page shows a fleet. */
    device: string;
    /** True if the page can read stored states. */
    has_history: boolean;
    /** Name of the sheet file's map. Empty if there is no sheet file. */
    map: string;
    sheets: { name: string; corners_mm: Pair[] }[];
    silent_after_s: number;
    gone_after_s: number;
}

export interface Alert {
    time_us: number;
    robot: string;
    state: Condition | "removed";
    /** Condition before the change. Empty for a new robot. */
    previous: string;
    reason: string;
    map?: string;
    sheet?: string;
}

/** A map, with the bounds of the robots on it. */
export interface KnownMap {
    name: string;
    robots: number;
    x_mm: Pair;
    y_mm: Pair;
}

export interface Summary {
    robots: number;
    states: Record<Condition, number>;
    /** Number of robots on maps or sheets that the sheet file does not contain. */
    unknown: number;
    states_per_s: number;
    messages: number;
    /**
     * Number of missed states. Undefined if several instances of `dotpose fleet` divide the states among themselves
     * (`--share`).
     */
    missed?: number;
    late: number;
    repeated: number;
    bad: number;
    /** Median and 99 % quantile of the latency. */
    latency_ms: Pair;
    is_broker_connected: boolean;
    store: { is_away: boolean; waiting: number; stored: number; dropped: number } | null;
    maps: KnownMap[];
    /** Alerts of all robots, newest first. */
    alerts: Alert[];
}

export interface Row {
    id: number;
    name: string;
    state: Condition;
    reason: string;
    age_s: number;
    messages: number;
    missed?: number;
    /** False if the robot is on a map or sheet that the sheet file does not contain. */
    is_known: boolean;
    /** Newest known map and sheet of the robot. Missing if none is known. */
    map?: string;
    sheet?: string;
    /** Position of the robot. Missing while the robot is lost. */
    x_mm?: number;
    y_mm?: number;
    theta_deg?: number;
    speed_mm_s?: number;
}

export interface Table {
    robots: number;
    matching: number;
    /** Index, among the matching robots, of the first robot in `rows`. */
    first: number;
    rows: Row[];
}

export interface Robot extends Row {
    late: number;
    repeated: number;
    deviation_mm?: number;
    camera?: { rate_hz: number; frames: number; refused: Record<string, number> };
    /** Pose of the camera in space. Missing while the robot is lost, or if its program does not compute this pose. */
    space?: { height_mm: number; tilt_deg: number };
    /** Recent path of the robot, as alternating x and y. */
    path_mm: number[];
    /** Events of the robot, newest first. */
    events: Alert[];
}

/** Stored states of a robot, downsampled to one value per time span. The arrays have one element for each span. */
export interface StoredHistory {
    /** Number of the request that this message answers. */
    ask: number;
    is_reading?: boolean;
    /** Reason why there are no states. */
    problem?: string;
    states: number;
    counts: Record<"moving" | "still" | "lost", number>;
    first_us: number;
    last_us: number;
    span_ms: number;
    max_speed_mm_s: number;
    is_cut: boolean;
    maps: string[];
    /** Time of each span, relative to `first_us`. */
    times_ms: number[];
    /** First position in the span. Null if the robot was lost. */
    x_mm: (number | null)[];
    y_mm: (number | null)[];
    /** Index in `maps` of the robot's map. */
    map_of: (number | null)[];
    /** Maximum speed in the span. */
    speeds_mm_s: number[];
    /** Motion in the span: 2 if the robot was lost. Otherwise, 0 if it moved and 1 if it was still. */
    motions: number[];
}

/** A stored track on a map. Each stroke contains alternating x and y. */
export interface Track {
    map: string;
    strokes_mm: number[][];
}

interface Head {
    map: string;
    origin_mm: Pair;
    count: number;
    names?: string[];
}

/** Size of a robot's record in the `positions` topic. */
const kRecordBytes = 16;
const kHasHeading = 1;
const kIsUnknown = 2;

/** The robots in view. The methods read the little-endian records directly, without creating an object per robot. */
export class Positions {
    readonly map: string;
    readonly count: number;
    readonly names: string[] | undefined;
    readonly #origin_mm: Pair;
    readonly #words: Uint32Array;
    readonly #floats: Float32Array;
    readonly #halves: Int16Array;
    readonly #bytes: Uint8Array;

    constructor(message: Uint8Array<ArrayBuffer>) {
        const { head, end } = headOf(message);
        [this.map, this.count, this.names, this.#origin_mm] = [head.map, head.count, head.names, head.origin_mm];
        // Copies the records, because the typed arrays require word alignment.
        const records = message.slice(end, end + head.count * kRecordBytes);
        this.#bytes = records;
        this.#words = new Uint32Array(records.buffer);
        this.#floats = new Float32Array(records.buffer);
        this.#halves = new Int16Array(records.buffer);
    }

    id(i: number): number {
        return this.#words[4 * i]!;
    }
    x_mm(i: number): number {
        return this.#origin_mm[0] + this.#floats[4 * i + 1]!;
    }
    y_mm(i: number): number {
        return this.#origin_mm[1] + this.#floats[4 * i + 2]!;
    }
    heading_rad(i: number): number {
        return this.#halves[8 * i + 6]! / 1e4;
    }
    /** Returns the index of the condition in `kConditions`. */
    condition(i: number): number {
        return this.#bytes[16 * i + 14]!;
    }
    hasHeading(i: number): boolean {
        return (this.#bytes[16 * i + 15]! & kHasHeading) !== 0;
    }
    isUnknown(i: number): boolean {
        return (this.#bytes[16 * i + 15]! & kIsUnknown) !== 0;
    }

    /** Returns the index of the robot with this number, or -1 if there is none. */
    indexOf(id: number): number {
        for (let i = 0; i < this.count; ++i) if (this.id(i) === id) return i;
        return -1;
    }
}

export interface Trails {
    map: string;
    /** Points of each trail, as alternating x and y, by robot number. */
    trails_mm: Map<number, Float64Array>;
}

/** Parses the head of a message: the size of the JSON (4 bytes), followed by the JSON. Returns the head, a view of the
 * message, and the offset at which the head ends. */
function headOf(bytes: Uint8Array<ArrayBuffer>): { head: Head; view: DataView; end: number } {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const end = 4 + view.getUint32(0, true);
    return { head: JSON.parse(new TextDecoder().decode(bytes.subarray(4, end))) as Head, view, end };
}

export function trailsOf(bytes: Uint8Array<ArrayBuffer>): Trails {
    const { head, view, end } = headOf(bytes);
    const trails_mm = new Map<number, Float64Array>();
    for (let i = 0, at = end; i < head.count; ++i) {
        const id = view.getUint32(at, true);
        const points = view.getUint32(at + 4, true);
        at += 8;
        const trail = new Float64Array(2 * points);
        for (let k = 0; k < 2 * points; ++k, at += 4) trail[k] = head.origin_mm[k % 2]! + view.getFloat32(at, true);
        trails_mm.set(id, trail);
    }
    return { map: head.map, trails_mm };
}
