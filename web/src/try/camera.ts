// The simulated camera: its pose, its motion, and the imaging conditions.
import type { SheetLayout, SimulatedView } from "../engine/messages.js";

/** A slider and the condition that it controls. */
export interface Slider {
    name: "mm_per_px" | "tilt_deg" | "turn_deg" | "blur_px" | "noise" | "paper_level" | "vignetting";
    label: string;
    min: number;
    max: number;
    step: number;
    /** Returns the text to display for a value. `px` is `SimulatedCamera.px`. */
    shown(value: number, px: number): string;
}

const percent = (value: number) => `${Math.round(100 * value)} %`;

export const kSliders: readonly Slider[] = [
    { name: "mm_per_px", label: "Height", min: 0.012, max: 0.085, step: 0.001, shown: (v, px) => `${(0.508 / (v * px)).toFixed(1)} px per spacing` },
    { name: "turn_deg", label: "Turn", min: -180, max: 180, step: 1, shown: (v) => `${Math.round(v)}°` },
    { name: "tilt_deg", label: "Tilt", min: 0, max: 35, step: 0.5, shown: (v) => `${v}°` },
    { name: "blur_px", label: "Blur", min: 0, max: 3.5, step: 0.1, shown: (v, px) => `${(v / px).toFixed(1)} px` },
    { name: "noise", label: "Noise", min: 0, max: 40, step: 1, shown: (v) => `${v} grey levels` },
    { name: "paper_level", label: "Light", min: 5, max: 250, step: 1, shown: (v) => percent(v / 250) },
    { name: "vignetting", label: "Dark corners", min: 0, max: 0.9, step: 0.05, shown: percent },
];

export type Conditions = Record<Slider["name"], number>;

export const kPresets: Record<string, Partial<Conditions>> = {
    clean: { tilt_deg: 0, blur_px: 0, noise: 0, paper_level: 200, vignetting: 0 },
    usual: { tilt_deg: 0, blur_px: 0.5, noise: 3, paper_level: 185, vignetting: 0.15 },
    hard: { tilt_deg: 4, blur_px: 1, noise: 9, paper_level: 90, vignetting: 0.5 },
};

/** Image size and field of view of the simulated camera. */
export interface ImageSize {
    width_px: number;
    height_px: number;
    /**
     * Width of the field of view, in pixels of the default image size. Images that are wider than `field_px` show the
     * field in more detail.
     */
    field_px: number;
}

export class SimulatedCamera {
    x_mm = 105;
    y_mm = 148;
    size: ImageSize = { width_px: 188, height_px: 120, field_px: 188 };
    readonly conditions: Conditions = {
        ...{ mm_per_px: 0.046, turn_deg: 20, tilt_deg: 0, blur_px: 0.5 },
        ...{ noise: 3, paper_level: 185, vignetting: 0.15 },
    };
    #seed = 1;

    /** Size of an image pixel, in pixels of the default image size. The sliders also use this unit. */
    get px(): number {
        return this.size.field_px / this.size.width_px;
    }
    get mm_per_px(): number {
        return this.conditions.mm_per_px * this.px;
    }
    get theta_rad(): number {
        return (this.conditions.turn_deg * Math.PI) / 180;
    }

    /** Moves the camera to a point on the page. Points outside the page are clamped to its edge. */
    moveTo(x_mm: number, y_mm: number, sheet: SheetLayout): void {
        this.x_mm = Math.min(Math.max(x_mm, 0), sheet.width_mm);
        this.y_mm = Math.min(Math.max(y_mm, 0), sheet.height_mm);
    }

    /** Moves the camera so that the image contents move by (du_px, dv_px), following the pointer. */
    dragBy(du_px: number, dv_px: number, sheet: SheetLayout): void {
        const [cos, sin] = [Math.cos(this.theta_rad), Math.sin(this.theta_rad)];
        const scale = this.mm_per_px;
        this.moveTo(
            this.x_mm - scale * (du_px * cos - dv_px * sin),
            this.y_mm - scale * (du_px * sin + dv_px * cos),
            sheet,
        );
    }

    turnBy(degrees: number): void {
        const turned = this.conditions.turn_deg + degrees;
        this.conditions.turn_deg = ((((turned + 180) % 360) + 360) % 360) - 180;
    }

    rise(factor: number): void {
        const { min, max } = kSliders[0]!;
        this.conditions.mm_per_px = Math.min(Math.max(this.conditions.mm_per_px * factor, min), max);
    }

    /** Returns the next view to simulate. Every frame has different noise. */
    view(): SimulatedView {
        const { tilt_deg, blur_px, noise, paper_level, vignetting } = this.conditions;
        const { x_mm, y_mm, mm_per_px, theta_rad } = this;
        const { width_px, height_px } = this.size;
        return {
            ...{ x_mm, y_mm, width_px, height_px, mm_per_px, theta_rad },
            tilt_x_rad: (tilt_deg * Math.PI) / 180,
            tilt_y_rad: 0,
            // All image sizes with the same field of view use the same lens, so the blur in px is proportional to the
            // image width in px.
            blur_px: blur_px / this.px,
            ...{ noise, paper_level, vignetting },
            seed: ++this.#seed,
        };
    }
}
