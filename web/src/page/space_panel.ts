// A panel that shows the pose of a camera in space as numbers, and as a drawing of the camera over the sheet.
import { element, show } from "./dom.js";
import { length } from "./format.js";
import { leanOf, type Angle, type SpacePose } from "./lean.js";

/** Points in the drawing: the point on the paper in the side view, and the centre of the top view. */
const kPaper = { x: 50, y: 88 };
const kAbove = { x: 150, y: 50 };
const kRadius = 40;
/**
 * An angle is shown only if its standard deviation is at most this value. For example, the azimuth of a camera without
 * tilt is undefined and therefore not shown.
 */
const kMaxSigma_deg = 45;
const kNothing = "–";

/** The HTML of the panel. The ids of its elements begin with `id`. */
const drawing = (id: string) => `
    <figcaption><span id="${id}-space-name">The camera over the sheet</span> <span class="quiet" id="${id}-space-source"></span></figcaption>
    <svg viewBox="0 0 200 104" role="img" aria-label="The camera from the side, and from above with the axes of the sheet">
        <line class="paper" x1="4" y1="88" x2="96" y2="88" />
        <line class="normal" x1="50" y1="88" x2="50" y2="16" />
        <g id="${id}-space-side">
            <line class="axis" x1="50" y1="88" x2="50" y2="34" />
            <path class="camera" d="M43 20h14v9l-3 5h-8l-3-5z" />
        </g>
        <text x="50" y="101">from the side</text>
        <rect class="paper" x="108" y="8" width="84" height="84" />
        <text x="187" y="46">x</text>
        <line class="normal" x1="150" y1="50" x2="190" y2="50" />
        <text id="${id}-space-y" x="157" y="88">y</text>
        <line class="normal" id="${id}-space-y-axis" x1="150" y1="50" x2="150" y2="90" />
        <g id="${id}-space-turn">
            <rect class="view" x="136" y="39.5" width="28" height="21" />
            <line class="view" x1="164" y1="50" x2="170" y2="50" />
        </g>
        <g id="${id}-space-lean">
            <line class="axis" id="${id}-space-arrow" x1="150" y1="50" x2="150" y2="50" />
            <circle class="camera" id="${id}-space-tip" cx="150" cy="50" r="4" />
        </g>
        <text x="150" y="101">from above</text>
    </svg>
    <dl class="readout" aria-label="Pose of the camera in space">
        <div><dt>height</dt><dd><span id="${id}-height">–</span> <span class="quiet" id="${id}-height-sigma"></span></dd></div>
        <div><dt>tilt</dt><dd><span id="${id}-tilt">–</span> <span class="quiet" id="${id}-tilt-sigma"></span></dd></div>
        <div><dt>azimuth of the tilt</dt><dd><span id="${id}-azimuth">–</span> <span class="quiet" id="${id}-azimuth-sigma"></span></dd></div>
        <div><dt>turn</dt><dd><span id="${id}-turn">–</span> <span class="quiet" id="${id}-turn-sigma"></span></dd></div>
    </dl>`;

/** A pose to show. */
export interface ShownPose {
    /** The pose, or null if it is not known. */
    pose: SpacePose | null;
    /** Source of the pose, for example "tracked". */
    source: string;
    /** True if the pose is in the world, whose y axis points up. Angles are then counterclockwise. */
    is_in_world: boolean;
}

const kNames = ["height", "tilt", "azimuth", "turn"];
/** A value and its standard deviation, as text. */
type Texts = [value: string, sigma: string];

function textsOf({ deg, sigma_deg }: Angle, sign = 1): Texts {
    if (!(sigma_deg < kMaxSigma_deg)) return [kNothing, ""];
    const digits = Math.min(Math.max(1 - Math.floor(Math.log10(sigma_deg)), 1), 4);
    return [`${(sign * deg).toFixed(digits)}°`, `± ${sigma_deg.toFixed(digits)}°`];
}

export class SpacePanel {
    readonly #figure: HTMLElement;
    readonly #id: string;

    /** Fills the `ID-space` figure. The figure is hidden until a pose is known. */
    constructor(id: string) {
        this.#id = id;
        this.#figure = element(`${id}-space`, HTMLElement);
        this.#figure.innerHTML = drawing(id);
    }

    hide(): void {
        this.#figure.hidden = true;
    }

    show({ pose, source, is_in_world }: ShownPose): void {
        const id = this.#id;
        if (pose) this.#figure.hidden = false;
        if (this.#figure.hidden) return;
        this.#figure.classList.toggle("unknown", pose === null);
        show({ [`${id}-space-source`]: source });
        if (pose === null) return this.#write(kNames.map(() => [kNothing, ""]));
        const { tilt, azimuth, turn } = leanOf(pose);
        const sign = is_in_world ? -1 : 1;
        show({ [`${id}-space-name`]: is_in_world ? "The camera in the world, y up" : "The camera over the sheet" });
        const height: Texts = [`${pose.height_mm.toFixed(3)} mm`, `± ${length(Math.sqrt(pose.covariance[14]!))}`];
        this.#write([height, textsOf(tilt), textsOf(azimuth, sign), textsOf(turn, sign)]);
        this.#draw(tilt.deg, azimuth.deg, turn.deg, is_in_world);
    }

    #write(texts: Texts[]): void {
        texts.forEach(([value, sigma], i) =>
            show({ [`${this.#id}-${kNames[i]}`]: value, [`${this.#id}-${kNames[i]}-sigma`]: sigma }),
        );
    }

    /**
     * Draws the camera. The top view shows the axes of the paper or of the world. The side view shows the vertical
     * plane in which the camera is tilted. The azimuth and the turn need no conversion, because they are clockwise on
     * the paper, and SVG angles are clockwise on the screen.
     */
    #draw(tilt_deg: number, azimuth_deg: number, turn_deg: number, is_in_world: boolean): void {
        const part = (name: string) => element(`${this.#id}-space-${name}`, SVGElement);
        const turned = (name: string, angle_deg: number, centre: { x: number; y: number }) =>
            part(name).setAttribute("transform", `rotate(${angle_deg.toFixed(2)} ${centre.x} ${centre.y})`);
        turned("side", tilt_deg, kPaper);
        turned("lean", azimuth_deg, kAbove);
        turned("turn", turn_deg, kAbove);
        part("y").setAttribute("y", is_in_world ? "18" : "88");
        part("y-axis").setAttribute("y2", is_in_world ? "10" : "90");
        const end = (kAbove.x + kRadius * Math.sin((tilt_deg * Math.PI) / 180)).toFixed(2);
        part("arrow").setAttribute("x2", end);
        part("tip").setAttribute("cx", end);
    }
}
