// The pose of the camera in space: numbers, and a drawing of the camera over the sheet.
import { element, show } from "../page/dom.js";
import type { Line } from "./messages.js";

/** Points of the drawing in live.html: the point on the paper, and the centre of the view from above. */
const kPaper = { x: 50, y: 88 };
const kAbove = { x: 150, y: 50 };
const kRadius = 40;

function turned(id: string, angle_deg: number, centre: { x: number; y: number }): void {
    const transform = `rotate(${angle_deg.toFixed(2)} ${centre.x} ${centre.y})`;
    element(id, SVGElement).setAttribute("transform", transform);
}

/**
 * Draws the camera. Angles of SVG are clockwise on the screen, as azimuth and turn are on the paper. The view
 * from above has the axes of the paper. The view from the side is in the plane in which the camera leans.
 */
function draw(tilt_deg: number, azimuth_deg: number, turn_deg: number): void {
    turned("live-space-side", tilt_deg, kPaper);
    turned("live-space-lean", azimuth_deg, kAbove);
    turned("live-space-turn", turn_deg, kAbove);
    const length = kRadius * Math.sin((tilt_deg * Math.PI) / 180);
    element("live-space-arrow", SVGElement).setAttribute("x2", (kAbove.x + length).toFixed(2));
    element("live-space-tip", SVGElement).setAttribute("cx", (kAbove.x + length).toFixed(2));
}

/** Shows the pose of a line with the keys of `--pose space`. Without these keys, the panel is hidden. */
export function showSpace(line: Line): void {
    const panel = element("live-space", HTMLElement);
    if (line.camera_z_mm !== undefined && line.camera_z_mm !== null) panel.hidden = false;
    if (panel.hidden) return;
    const is_known = typeof line.camera_z_mm === "number";
    panel.classList.toggle("unknown", !is_known);
    if (!is_known) {
        show({ "live-height": "–", "live-tilt": "–", "live-azimuth": "–", "live-turn": "–" });
        return;
    }
    const [tilt_deg, azimuth_deg, turn_deg] = [line.camera_tilt_deg!, line.camera_azimuth_deg!, line.camera_turn_deg!];
    show({
        "live-height": `${(-line.camera_z_mm!).toFixed(3)} mm`,
        "live-tilt": `${tilt_deg.toFixed(2)}°`,
        "live-azimuth": `${azimuth_deg.toFixed(1)}°`,
        "live-turn": `${turn_deg.toFixed(2)}°`,
    });
    draw(tilt_deg, azimuth_deg, turn_deg);
}
