// How one frame is read, step by step, in pictures.
import { drawFrame, type Layers } from "../draw/frame.js";
import { kSymbolInk } from "../draw/surface.js";
import type { Reading } from "../engine/messages.js";
import { element, make } from "../page/dom.js";
import { degrees, length, milliseconds, mm, oneIn } from "../page/format.js";

interface Step {
    title: string;
    text: (reading: Reading) => (Node | string)[];
    layers: Layers;
    /** Whether the reading got so far. */
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
            `${width_px} x ${height_px} grey pixels, ${Math.round(quality.brightness)} bright on average, ${quality.contrast} levels from dark to light.`,
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
        text: ({ fix }) => [`They lie about the crossings of a square grid, ${fix.spacing_px.toFixed(1)} pixels apart. Turn, tilt and lens follow from it.`],
        layers: { frame: 0.45, found: true, grid: true },
        reached: isRead,
    },
    {
        title: "The symbols",
        text: () => ["Each dot stands beside its crossing, in one of four directions:", ...legend(), ". That is two bits."],
        layers: { frame: 0.12, grid: true, symbols: true },
        reached: isRead,
    },
    {
        title: "The place",
        text: ({ fix }) => [
            `Along a line the bits spell numbers that stand at one place of the code only: column ${fix.cell.x.toLocaleString("en")}, row ${fix.cell.y.toLocaleString("en")}, section ${fix.section.u}, ${fix.section.v}. ${fix.bit_errors} of ${2 * fix.dots_used} bits contradict it; it is wrong with at most ${oneIn(fix.p_wrong)}.`,
        ],
        layers: { frame: 0.12, grid: true, symbols: true, pose: true },
        reached: isRead,
    },
    {
        title: "The pose",
        text: ({ fix, locate_ms }) => [
            `All ${fix.dots_used} dots together say where the middle of the picture is: x ${mm(fix.x_mm)}, y ${mm(fix.y_mm)}, turned by ${degrees(fix.theta_rad)}, exact to ${length(Math.sqrt(fix.covariance[0]!))}. It took ${milliseconds(locate_ms)}.`,
        ],
        layers: { pose: true },
        reached: isRead,
    },
];

/** Shows the steps that the reading reached, and where it ended. */
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
        items.push(make("li", {}, make("h3", {}, "Here it ended"), make("p", {}, `No position: ${reading.fix.message}.`)));
    element("explain-steps", HTMLElement).replaceChildren(...items);
    dialog.showModal();
    const draw = () => reached.forEach(({ layers }, i) => drawFrame(canvases[i]!, reading, layers));
    draw();
    addEventListener("resize", draw);
    const done = () => removeEventListener("resize", draw);
    dialog.addEventListener("close", done, { once: true });
}

/** Lets the dialog be closed; `closed` is called each time. */
export function listenToExplain(closed: () => void): void {
    const dialog = element("explain", HTMLDialogElement);
    element("explain-close", HTMLButtonElement).addEventListener("click", () => dialog.close());
    dialog.addEventListener("close", closed);
}
