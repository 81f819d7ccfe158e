// Values published on the sheet topics (docs/web.md). apps/dotpose-live/sheet_messages.cpp writes them.

/** Pose of the upper left corner of a page in the world, with y up. */
export interface Pose {
    x_mm: number;
    y_mm: number;
    /** Direction of the upper edge, counter-clockwise. */
    yaw_deg: number;
}

export interface Sheet {
    name: string;
    /** Increases with each change of the sheet. */
    revision: number;
    page: number;
    width_mm: number;
    height_mm: number;
    columns: number;
    rows: number;
    code: string;
    spacing_mm: number;
    origin: [number, number];
    first_x_mm: number;
    first_y_mm: number;
    scale_x: number;
    scale_y: number;
    is_reserved: boolean;
    world: Pose | null;
    print: { title: string; pages: number; dpi: number; command: string; document: string } | null;
}

export interface SheetFile {
    may_edit: boolean;
    /** Reason why the file could not be read. Empty if it was read. */
    problem: string;
    /** Descriptions of the edits that can be undone and redone. Empty if there are none. */
    undo: string;
    redo: string;
    /** Number of sheets that the message omits. */
    not_shown: number;
    sheets: Sheet[];
}

export interface Answer {
    id: string;
    is_ok: boolean;
    message: string;
    /** Name of a new sheet, or empty. */
    name: string;
    /** Path of a file to download, or empty. */
    url: string;
}

export interface Measurement {
    is_on: boolean;
    tried: number;
    frames: number;
    is_complete: boolean;
    problem: string;
    pairs: { first: string; second: string; frames: number; residual_mm: number; residual_deg: number }[];
    sheets: {
        name: string;
        is_fixed: boolean;
        sigma_mm: number;
        sigma_deg: number;
        scale_x: number;
        scale_y: number;
        is_scale_known: boolean;
        world: Pose | null;
    }[];
    unconnected: string[];
}
