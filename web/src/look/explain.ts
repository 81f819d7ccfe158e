// Explains step by step, with pictures, how a frame is located.
import { drawFrame, type Layers } from "../draw/frame.js";
import { kSymbolInk } from "../draw/surface.js";
import type { Reading } from "../engine/messages.js";
import { drawnFrame } from "../engine/overlay.js";
import { element, make } from "../page/dom.js";
import { degrees, length, milliseconds, mm, oneIn } from "../page/format.js";

interface Step {
    title: string;
    text: (reading: Reading) => (Node | string)[];
    layers: Layers;
    /** True if the reading reached this step. */
    reached: (reading: Reading) => boolean;
}

function legend(): (Node | string)[] {
    return ["up", "left", "right", "down"].flatMap((name, symbol) => {
        const mark = make("span", { className: "legend" });
        mark.style.background = kSymbolInk[symbol]!;
        return [mark, name];
    });
}

const isRead = ({ fix }: Reading) => fix.ok;
const isSeen = ({ fix }: Reading) => fix.dots !== null && fix.dots.length > 0;

const kSteps: readonly Step[] = [
    {
        title: "The frame",
        text: ({ width_px, height_px, quality }) => [
            `${width_px} x ${height_px} grey pixels with a mean of ${Math.round(quality.brightness)} and a contrast of ${quality.contrast} grey levels.`,
        ],
        layers: {},
        reached: () => true,
    },
    {
        title: "The dots",
        text: ({ fix }) => [`${fix.dots_seen} dark spots have the size of a dot. Their centres are measured to a hundredth of a pixel.`],
        layers: { frame: 0.45, found: true },
        reached: isSeen,
    },
    {
        title: "The grid",
        text: ({ fix }) => [`The dots are near the intersections of a square grid with a spacing of ${fix.spacing_px.toFixed(1)} pixels, which shows turn, tilt and lens distortion.`],
        layers: { frame: 0.45, found: true, grid: true },
        reached: isRead,
    },
    {
        title: "The symbols",
        text: () => ["Each dot is displaced from its intersection in one of four directions, which encode two bits:", ...legend(), "."],
        layers: { frame: 0.12, grid: true, symbols: true },
        reached: isRead,
    },
    {
        title: "The place",
        text: ({ fix }) => [
            `The bits ${fix.prior === "plane" ? "of each line occur at only one place of the code" : "agree with only one place on the known sheets"}: column ${fix.cell.x.toLocaleString("en")}, row ${fix.cell.y.toLocaleString("en")}, section ${fix.section.u}, ${fix.section.v}. ${fix.bit_errors} of ${2 * fix.dots_used} bits contradict this place. The chance that it is wrong is at most ${oneIn(fix.p_wrong)}.`,
        ],
        layers: { frame: 0.12, grid: true, symbols: true, pose: true },
        reached: isRead,
    },
    {
        title: "The pose",
        text: ({ fix, locate_ms }) => [
            `A fit to all ${fix.dots_used} dots gives the position of the middle of the picture: x ${mm(fix.x_mm)}, y ${mm(fix.y_mm)}, turned by ${degrees(fix.theta_rad)}, with a standard deviation of ${length(Math.sqrt(fix.covariance[0]!))}. This took ${milliseconds(locate_ms)}.`,
        ],
        layers: { pose: true },
        reached: isRead,
    },
];

/** Shows the steps that the reading reached, and the reason for failure if there is no position. */
export function explain(reading: Reading): void {
    const dialog = element("explain", HTMLDialogElement);
    const reached = kSteps.filter((step) => step.reached(reading));
    const canvases = reached.map(({ title }) => {
        const canvas = make("canvas", { className: "screen" });
        canvas.setAttribute("role", "img");
        canvas.setAttribute("aria-label", title);
        return canvas;
    });
    const items = reached.map(({ title, text }, i) =>
        make("li", {}, canvases[i]!, make("h3", {}, title), make("p", {}, ...text(reading))),
    );
    if (!reading.fix.ok)
        items.push(make("li", {}, make("h3", {}, "The search failed here"), make("p", {}, `No position: ${reading.fix.message}.`)));
    element("explain-steps", HTMLElement).replaceChildren(...items);
    dialog.showModal();
    const frame = drawnFrame(reading);
    const draw = () => reached.forEach(({ layers }, i) => drawFrame(canvases[i]!, frame, layers));
    draw();
    addEventListener("resize", draw);
    const done = () => removeEventListener("resize", draw);
    dialog.addEventListener("close", done, { once: true });
}

/** Connects the close button of the dialog, and calls `closed` whenever the dialog closes. */
export function listenToExplain(closed: () => void): void {
    const dialog = element("explain", HTMLDialogElement);
    element("explain-close", HTMLButtonElement).addEventListener("click", () => dialog.close());
    dialog.addEventListener("close", closed);
}
