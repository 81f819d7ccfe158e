// The simulated camera over a simulated sheet.
import { Tools } from "dotpose/tools";
import type { Image } from "dotpose";
import { patternFromPage } from "../page/sheet_frame.js";
import type { SheetChoice, SheetLayout, SimulatedView } from "./messages.js";

let tools: Promise<Tools> | undefined;
const layouts = new Map<string, SheetLayout>();

/** Returns the layout of a sheet. */
export async function layoutOf(sheet: SheetChoice): Promise<SheetLayout> {
    const key = JSON.stringify(sheet);
    let layout = layouts.get(key);
    if (layout === undefined) {
        const { columns, rows, origin_x_mm, origin_y_mm } = (await (tools ??= Tools.create())).layout(sheet);
        layout = { ...sheet, columns, rows, first_x_mm: origin_x_mm, first_y_mm: origin_y_mm };
        layouts.set(key, layout);
    }
    return layout;
}

/** Imperfections of an ordinary print and its paper, as in the `nominal` preset of the command-line tool. */
const kPrint = { jitter_mm: 0.01, ink_variation: 0.03, missing: 0.002, texture: 0.005 };
/** Distance of the projection centre from the paper, relative to the width of the view. */
const kDistancePerWidth = 2;

/** Returns a frame from the simulated camera. */
export async function render(sheet: SheetChoice, view: SimulatedView): Promise<Image> {
    const layout = await layoutOf(sheet);
    const { width_px, height_px, mm_per_px, theta_rad, tilt_x_rad, tilt_y_rad } = view;
    const working_distance_mm = kDistancePerWidth * width_px * mm_per_px;
    return (await tools!).render({
        sheet,
        camera: { width_px, height_px, mm_per_px, working_distance_mm },
        pose: { ...patternFromPage(layout, view), theta_rad, tilt_x_rad, tilt_y_rad },
        imperfections: {
            ...kPrint,
            paper_level: view.paper_level,
            vignetting: view.vignetting,
            blur_sigma_px: view.blur_px,
            noise_sigma: view.noise,
        },
        seed: view.seed,
    });
}
