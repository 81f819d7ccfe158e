// The map of all sheets. The user selects, moves and turns the sheets on it.
import { surfaceOf } from "../draw/surface.js";
import { element, show } from "../page/dom.js";
import type { Point_mm } from "../page/sheet_frame.js";
import { drawGrid, drawRobot, drawScale, drawSheet, type Frame, handleOf, kHandle_px, kHandleReach_px, type RobotOnSheet, worldAt } from "./sheets_drawing.js";
import { boxOf, cornersOf, isOn, layOut, middleOf, moved, type Placed, rounded, turned } from "./sheets_geometry.js";
import type { Pose, Sheet } from "./sheets_messages.js";

const kMargin_px = 24;
const kZoom = 1.25;
/** Delay between the last key press and the saving of a pose changed with the keyboard. */
const kKeyPause_ms = 700;

export interface MapEvents {
    select(name: string): void;
    /** Called when the user has moved or turned a sheet. The promise resolves to true if the pose was saved. */
    place(sheet: Sheet, pose: Pose): Promise<boolean>;
}

interface Drag {
    kind: "pan" | "move" | "turn";
    from: Point_mm;
    /** The sheet under the pointer, as it was before the gesture. */
    on: Placed | undefined;
    has_moved: boolean;
}

export class SheetsMap {
    readonly #canvas = element("sheets-map", HTMLCanvasElement);
    readonly #events: MapEvents;
    #sheets: Sheet[] = [];
    #may_edit = false;
    #selected = "";
    #robot: RobotOnSheet | null = null;
    /** Pose of a sheet that is being moved, or whose new pose has not been saved yet. */
    #changed: { name: string; pose: Pose } | null = null;
    #drag: Drag | null = null;
    #key_timer: ReturnType<typeof setTimeout> | undefined;
    /** Sheet that is being moved with the keyboard, as it was before the first key press. */
    #key_sheet: Sheet | undefined;
    /** World point at the centre of the canvas, and the scale. Null while all sheets are shown. */
    #view: { x_mm: number; y_mm: number; scale: number } | null = null;
    #frame: Frame = { x_mm: 0, y_mm: 0, scale: 1, width: 1, height: 1 };

    constructor(events: MapEvents) {
        this.#events = events;
        const canvas = this.#canvas;
        canvas.addEventListener("pointerdown", (event) => this.#press(event));
        canvas.addEventListener("pointermove", (event) => this.#move(event));
        canvas.addEventListener("pointerup", (event) => this.#release(event));
        canvas.addEventListener("pointercancel", () => this.#cancel());
        canvas.addEventListener("pointerleave", () => show({ "sheets-pointer": "" }));
        canvas.addEventListener("keydown", (event) => this.#key(event));
        canvas.addEventListener("blur", () => this.#saveKeys());
        canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
        const zoom = (factor: number) => () => this.#zoom(factor, this.#canvas.clientWidth / 2, this.#canvas.clientHeight / 2);
        element("sheets-nearer", HTMLButtonElement).addEventListener("click", zoom(kZoom));
        element("sheets-farther", HTMLButtonElement).addEventListener("click", zoom(1 / kZoom));
        element("sheets-fit", HTMLButtonElement).addEventListener("click", () => {
            this.#view = null;
            this.redraw();
        });
    }

    take(sheets: Sheet[], may_edit: boolean): void {
        this.#sheets = sheets;
        this.#may_edit = may_edit;
        this.redraw();
    }

    select(name: string): void {
        if (name !== this.#selected) this.#saveKeys();
        this.#selected = name;
        this.redraw();
    }

    takeRobot(robot: RobotOnSheet | null): void {
        this.#robot = robot;
        this.redraw();
    }

    redraw(): void {
        const { context, width, height } = surfaceOf(this.#canvas);
        if (width === 0) return;
        const placed = this.#placed();
        this.#fit(placed, width, height);
        drawGrid(context, this.#frame);
        const style = { is_selected: false, has_handle: false };
        for (const one of placed.filter(({ sheet }) => sheet.name !== this.#selected)) drawSheet(context, this.#frame, one, style);
        const selected = this.#find(this.#selected);
        if (selected) drawSheet(context, this.#frame, selected, { is_selected: true, has_handle: this.#may_edit });
        const on = this.#robot && this.#find(this.#robot.sheet);
        if (this.#robot && on) drawRobot(context, this.#frame, this.#robot, on);
        drawScale(context, this.#frame);
    }

    #placed(): Placed[] {
        return layOut(this.#sheets).map((one) => {
            const pose = one.sheet.name === this.#changed?.name ? this.#changed.pose : null;
            return pose ? { ...one, pose, is_known: true } : one;
        });
    }

    #find(name: string): Placed | undefined {
        return this.#placed().find(({ sheet }) => sheet.name === name);
    }

    #fit(placed: readonly Placed[], width: number, height: number): void {
        if (this.#drag) return; // the map must not move under the pointer
        let view = this.#view;
        if (!view) {
            const box = placed.length > 0 ? boxOf(placed.flatMap((one) => cornersOf(one.sheet, one.pose))) : { left: 0, right: 1, low: 0, high: 1 };
            const scale = Math.min((width - 2 * kMargin_px) / (box.right - box.left), (height - 2 * kMargin_px - kHandleReach_px) / (box.high - box.low));
            view = { x_mm: (box.left + box.right) / 2, y_mm: (box.low + box.high) / 2 + kHandleReach_px / 2 / scale, scale };
        }
        this.#frame = { ...view, width, height };
    }

    #press(event: PointerEvent): void {
        if (event.button !== 0 || this.#drag) return;
        this.#saveKeys();
        this.#canvas.setPointerCapture(event.pointerId);
        const from = worldAt(this.#frame, event.offsetX, event.offsetY);
        const selected = this.#find(this.#selected);
        const handle = selected && handleOf(this.#frame, selected);
        const is_on_handle = handle && this.#may_edit && Math.hypot(event.offsetX - handle[0], event.offsetY - handle[1]) < 2 * kHandle_px;
        const hit = is_on_handle ? selected : this.#hit(from);
        // A finger that scrolls the page must not move a sheet, so touch moves only the selected sheet.
        const may_move = this.#may_edit && (event.pointerType === "mouse" || hit?.sheet.name === this.#selected);
        if (hit && hit.sheet.name !== this.#selected) this.#events.select(hit.sheet.name);
        const kind = is_on_handle ? "turn" : hit && may_move ? "move" : "pan";
        this.#drag = { kind, from, on: hit, has_moved: false };
    }

    #hit(point: Point_mm): Placed | undefined {
        const selected = this.#find(this.#selected);
        if (selected && isOn(selected.sheet, selected.pose, point)) return selected;
        return this.#placed().reverse().find(({ sheet, pose }) => isOn(sheet, pose, point));
    }

    #move(event: PointerEvent): void {
        const to = worldAt(this.#frame, event.offsetX, event.offsetY);
        show({ "sheets-pointer": `x ${to.x_mm.toFixed(1)}, y ${to.y_mm.toFixed(1)} mm` });
        const drag = this.#drag;
        if (!drag) return;
        const [x_mm, y_mm] = [to.x_mm - drag.from.x_mm, to.y_mm - drag.from.y_mm];
        // A press without movement only selects a sheet.
        if (!drag.has_moved && Math.hypot(x_mm, y_mm) * this.#frame.scale < 4) return;
        drag.has_moved = true;
        if (drag.kind === "pan") {
            const view = { x_mm: this.#frame.x_mm - x_mm, y_mm: this.#frame.y_mm - y_mm, scale: this.#frame.scale };
            this.#view = view;
            this.#frame = { ...this.#frame, ...view };
        } else if (drag.on && drag.kind === "move") {
            this.#change(drag.on.sheet, moved(drag.on.pose, x_mm, y_mm));
        } else if (drag.on) {
            this.#turn(drag.on, to, event.shiftKey ? 15 : 0.1);
        }
        this.redraw();
    }

    /** Turns a sheet so that its upper edge faces a point. */
    #turn({ sheet, pose }: Placed, to: Point_mm, step_deg: number): void {
        const middle = middleOf(sheet, pose);
        const angle_deg = (Math.atan2(to.y_mm - middle.y_mm, to.x_mm - middle.x_mm) * 180) / Math.PI;
        this.#change(sheet, turned(sheet, pose, Math.round((angle_deg - 90) / step_deg) * step_deg));
    }

    #change(sheet: Sheet, pose: Pose): void {
        this.#changed = { name: sheet.name, pose: rounded(pose) };
    }

    #release(event: PointerEvent): void {
        const drag = this.#drag;
        this.#drag = null;
        this.#canvas.releasePointerCapture(event.pointerId);
        if (drag?.has_moved && drag.on && drag.kind !== "pan") void this.#save(drag.on.sheet);
        this.redraw();
    }

    #cancel(): void {
        this.#drag = null;
        this.#changed = null;
        this.redraw();
    }

    /** Saves the changed pose. `sheet` is the sheet before the change, as the user saw it. */
    async #save(sheet: Sheet): Promise<void> {
        const changed = this.#changed;
        if (!changed) return;
        await this.#events.place(sheet, changed.pose);
        if (this.#changed === changed) this.#changed = null;
        this.redraw();
    }

    #saveKeys(): void {
        if (this.#key_timer === undefined) return;
        clearTimeout(this.#key_timer);
        this.#key_timer = undefined;
        if (this.#key_sheet) void this.#save(this.#key_sheet);
    }

    #key(event: KeyboardEvent): void {
        if (event.ctrlKey || event.metaKey) return;
        const names = this.#sheets.map(({ name }) => name);
        const at = names.indexOf(this.#selected);
        const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
        const step_mm = event.shiftKey ? 10 : event.altKey ? 0.1 : 1;
        const step_deg = event.shiftKey ? 10 : 1;
        const kSteps: Record<string, [number, number, number]> = {
            ...{ ArrowLeft: [-step_mm, 0, 0], ArrowRight: [step_mm, 0, 0], ArrowUp: [0, step_mm, 0], ArrowDown: [0, -step_mm, 0] },
            ...{ l: [0, 0, step_deg], r: [0, 0, -step_deg] },
        };
        const next = { n: at + 1, p: at - 1 }[key];
        if (next !== undefined && names.length > 0) {
            this.#events.select(names[(next + names.length) % names.length]!);
        } else if (key === "Escape") {
            clearTimeout(this.#key_timer);
            this.#key_timer = undefined;
            this.#cancel();
        } else if (key === "+" || key === "-") {
            this.#zoom(key === "+" ? kZoom : 1 / kZoom, this.#canvas.clientWidth / 2, this.#canvas.clientHeight / 2);
        } else if (kSteps[key]) {
            this.#step(kSteps[key]);
        } else {
            return;
        }
        event.preventDefault();
    }

    /** Moves and turns the selected sheet. The pose is saved after a pause. */
    #step([x_mm, y_mm, turn_deg]: readonly [number, number, number]): void {
        const selected = this.#find(this.#selected);
        if (!selected || !this.#may_edit) return;
        if (this.#key_timer === undefined) this.#key_sheet = selected.sheet;
        clearTimeout(this.#key_timer);
        const pose = moved(selected.pose, x_mm, y_mm);
        this.#change(selected.sheet, turn_deg === 0 ? pose : turned(selected.sheet, pose, pose.yaw_deg + turn_deg));
        this.#key_timer = setTimeout(() => this.#saveKeys(), kKeyPause_ms);
        this.redraw();
    }

    #wheel(event: WheelEvent): void {
        event.preventDefault();
        this.#zoom(Math.exp(-event.deltaY / 400), event.offsetX, event.offsetY);
    }

    /** Zooms. The world point under (u, v) stays in place. */
    #zoom(factor: number, u: number, v: number): void {
        const [kMin, kMax] = [1e-4, 1e3];
        const { x_mm, y_mm } = worldAt(this.#frame, u, v);
        const { width, height } = this.#frame;
        const scale = Math.min(Math.max(this.#frame.scale * factor, kMin), kMax);
        this.#view = { x_mm: x_mm - (u - width / 2) / scale, y_mm: y_mm + (v - height / 2) / scale, scale };
        this.redraw();
    }
}
