// Values that `dotpose watch --web` publishes on its topics (docs/web.md). apps/dotpose-live/web_view.cpp writes them.
import type { DrawnFrame } from "../draw/frame.js";
import type { Quaternion } from "../page/lean.js";

type Pair = readonly [number, number];

export interface Setup {
    robot: string;
    source: string;
    /** Plane of the track: the world of the sheet file, with y up, or the pattern, with y down. */
    plane: "world" | "pattern";
    sheets: { name: string; corners_mm: Pair[] }[];
    has_sheet_file: boolean;
    /** Address of the run's log, or null. */
    log: string | null;
}

/** Returns the name of the source as text. */
export function sourceText({ source }: Setup): string {
    return source === "-" ? "standard input" : source;
}

/** The keys of a `dotpose watch` output line that the page shows (docs/schema/lines-1.json). */
export interface Line {
    frame: number;
    t_s: number;
    status: string;
    dots_seen: number;
    dots_used?: number;
    bit_errors?: number;
    p_wrong?: number;
    spacing_px?: number;
    sheet?: string | null;
    x_sheet_mm?: number | null;
    y_sheet_mm?: number | null;
    theta_sheet_deg?: number | null;
    state: "lost" | "moving" | "stationary";
    track_x_mm?: number | null;
    track_y_mm?: number | null;
    track_theta_deg?: number | null;
    vx_mm_s?: number | null;
    vy_mm_s?: number | null;
    track_sigma_mm?: number | null;
    // Keys added by `--pose space`.
    camera_z_mm?: number | null;
    camera_quaternion_xyzw?: Quaternion | null;
    camera_covariance_mm_deg?: number[] | null;
    camera_track_z_mm?: number | null;
    camera_track_quaternion_xyzw?: Quaternion | null;
    camera_track_covariance_mm_deg?: number[] | null;
    camera_track_z_m?: number | null;
    camera_track_quaternion_world_xyzw?: Quaternion | null;
    camera_track_covariance_m_rad?: number[] | null;
}

export interface State {
    line: Line;
    /** Frame rate over the last second. */
    rate_hz: number;
    frames: number;
    fixes: number;
    lost: number;
    dropped: number;
    clients: number;
    warnings: string[];
    recording: { is_on: boolean; name: string; frames: number; notice: string; files: string[] };
}

/** Number of frames with each status, for each second in which there were frames. */
export interface History {
    seconds: { second: number; frames: Record<string, number> }[];
}

export interface Path {
    /** Strokes of the path. Each stroke contains alternating x and y. */
    strokes_mm: number[][];
    visited: string[];
}

export interface Advice {
    /** Reason why the newest frame was refused, and advice. Empty if the frame was located. */
    reason: string;
}

/** Header of a frame message. A JPEG picture follows it. */
interface FrameHead {
    frame: number;
    width_px: number;
    height_px: number;
    overlay: {
        dots: number[];
        grid: number[][];
        spacing_px: number;
        axes: [number, number, number, number, number, number] | null;
    };
}

export interface LiveFrame extends DrawnFrame {
    picture: ImageBitmap;
    index: number;
}

/** Parses a frame message: the size of the header, the header as JSON, and a JPEG picture. */
export async function frameOf(bytes: Uint8Array<ArrayBuffer>): Promise<LiveFrame> {
    const kSizeBytes = 4;
    const end = kSizeBytes + new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);
    const head = JSON.parse(new TextDecoder().decode(bytes.subarray(kSizeBytes, end))) as FrameHead;
    const picture = await createImageBitmap(new Blob([bytes.subarray(end)], { type: "image/jpeg" }));
    const { dots, grid, spacing_px, axes: a } = head.overlay;
    const axes = a && ({ at: [a[0], a[1]], x: [a[2], a[3]], y: [a[4], a[5]] } as const);
    return {
        index: head.frame,
        picture,
        width_px: head.width_px,
        height_px: head.height_px,
        overlay: { dots, grid, spacing_px, symbols: [], axes },
    };
}
