// Values of the topics of `dotpose fleet --web` (docs/fleet.md). apps/dotpose-live/fleet_values.cpp and
// fleet_map_values.cpp write them.

type Pair = readonly [number, number];

export const kConditions = ["moving", "still", "lost", "silent", "gone"] as const;
export type Condition = (typeof kConditions)[number];

export interface Setup {
    /** Name of the robot of `dotpose listen`; empty for a fleet. */
    device: string;
    /** Name of the map of the sheet file; empty without a file. */
    map: string;
    sheets: { name: string; corners_mm: Pair[] }[];
    silent_after_s: number;
    gone_after_s: number;
}

export interface Alert {
    time_us: number;
    robot: string;
    state: Condition | "removed";
    /** Condition before the change; empty for a new robot. */
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
    /** Missing if several fleets share the states. */
    missed?: number;
    late: number;
    repeated: number;
    bad: number;
    /** Median and 99 % quantile. */
    latency_ms: Pair;
    is_broker_connected: boolean;
    store: { is_away: boolean; waiting: number; stored: number; dropped: number } | null;
    maps: KnownMap[];
    /** Newest first. */
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
    /** Newest known place. Missing if the robot never knew its place. */
    map?: string;
    sheet?: string;
    /** Missing while the robot is lost. */
    x_mm?: number;
    y_mm?: number;
    theta_deg?: number;
    speed_mm_s?: number;
}

export interface Table {
    robots: number;
    matching: number;
    /** Index of the first row. */
    first: number;
    rows: Row[];
}

export interface Robot extends Row {
    late: number;
    repeated: number;
    deviation_mm?: number;
    camera?: { rate_hz: number; frames: number; refused: Record<string, number> };
    /** x and y alternately. */
    path_mm: number[];
    /** Newest first. */
    events: Alert[];
}

interface Head {
    map: string;
    origin_mm: Pair;
    count: number;
    names?: string[];
}

/** The robots in view. The arrays have one element, or two coordinates, for each robot. */
export interface Positions extends Head {
    ids: Uint32Array;
    at_mm: Float64Array;
    headings_rad: Float32Array;
    conditions: Uint8Array;
    flags: Uint8Array;
}

export const kHasHeading = 1;
export const kIsUnknown = 2;

export interface Trails {
    map: string;
    /** x and y alternately, by the number of the robot. */
    trails_mm: Map<number, Float64Array>;
}

/** Reads the size of the head, and the head as JSON. Returns the head and its end. */
function headOf(bytes: Uint8Array<ArrayBuffer>): { head: Head; view: DataView; end: number } {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const end = 4 + view.getUint32(0, true);
    return { head: JSON.parse(new TextDecoder().decode(bytes.subarray(4, end))) as Head, view, end };
}

export function positionsOf(bytes: Uint8Array<ArrayBuffer>): Positions {
    const { head, view, end } = headOf(bytes);
    const kRecordBytes = 16;
    const count = head.count;
    const positions = {
        ...head,
        ids: new Uint32Array(count),
        at_mm: new Float64Array(2 * count),
        headings_rad: new Float32Array(count),
        conditions: new Uint8Array(count),
        flags: new Uint8Array(count),
    };
    for (let i = 0, at = end; i < count; ++i, at += kRecordBytes) {
        positions.ids[i] = view.getUint32(at, true);
        positions.at_mm[2 * i] = head.origin_mm[0] + view.getFloat32(at + 4, true);
        positions.at_mm[2 * i + 1] = head.origin_mm[1] + view.getFloat32(at + 8, true);
        positions.headings_rad[i] = view.getInt16(at + 12, true) / 1e4;
        positions.conditions[i] = view.getUint8(at + 14);
        positions.flags[i] = view.getUint8(at + 15);
    }
    return positions;
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
