// Measures the poses of sheets with the live camera.
import { element, make, show } from "../page/dom.js";
import type { Connection, Value } from "./connection.js";
import { showAnswer, type SheetCommands } from "./sheets_commands.js";
import type { Measurement } from "./sheets_messages.js";

function rowOf(...texts: string[]): HTMLTableRowElement {
    return make("tr", {}, ...texts.map((text) => make("td", { textContent: text })));
}

export class Stitching {
    readonly #start = element("stitch-start", HTMLButtonElement);
    readonly #accept = element("stitch-accept", HTMLButtonElement);
    readonly #discard = element("stitch-discard", HTMLButtonElement);
    #may_edit = false;

    constructor(connection: Connection, commands: SheetCommands) {
        for (const button of [this.#start, this.#accept, this.#discard]) {
            button.addEventListener("click", async () => {
                const answer = await commands.send(button.id);
                if (!answer.is_ok || answer.message !== "") showAnswer(answer);
            });
        }
        connection.subscribe("stitch", (value: Value) => this.#take(JSON.parse(value as string) as Measurement));
    }

    enable(may_edit: boolean, sheets: number): void {
        this.#may_edit = may_edit;
        this.#start.disabled = !may_edit || sheets < 2;
    }

    #take(measurement: Measurement): void {
        const { is_on } = measurement;
        this.#start.hidden = is_on;
        this.#accept.hidden = this.#discard.hidden = !is_on;
        this.#discard.disabled = !this.#may_edit;
        element("stitch-progress", HTMLElement).hidden = !is_on;
        if (!is_on) return;
        const { tried, frames, is_complete, problem, pairs, sheets, unconnected } = measurement;
        this.#accept.disabled = !this.#may_edit || sheets.length === 0;
        const more = is_complete ? " Enough frames were seen." : "";
        show({ "stitch-frames": `${frames} of ${tried} frames show two sheets.${more}`, "stitch-problem": problem });
        element("stitch-problem", HTMLElement).hidden = problem === "";
        element("stitch-results", HTMLElement).hidden = pairs.length === 0;
        element("stitch-pairs", HTMLTableSectionElement).replaceChildren(
            ...pairs.map(({ first, second, frames, residual_mm, residual_deg }) =>
                rowOf(`${first} – ${second}`, String(frames), `${residual_mm.toFixed(4)} mm, ${residual_deg.toFixed(3)}°`),
            ),
        );
        element("stitch-sheets", HTMLTableSectionElement).replaceChildren(
            ...sheets.map(({ name, world, is_fixed, sigma_mm, sigma_deg, scale_x, scale_y, is_scale_known }) =>
                rowOf(
                    name,
                    world ? `${world.x_mm.toFixed(3)}, ${world.y_mm.toFixed(3)} mm, ${world.yaw_deg.toFixed(3)}°` : "–",
                    is_fixed ? "keeps its place" : `${sigma_mm.toFixed(4)} mm, ${sigma_deg.toFixed(4)}°`,
                    `${scale_x.toFixed(5)}, ${scale_y.toFixed(5)}${is_scale_known ? "" : " (not measured)"}`,
                ),
            ),
        );
        const missing = unconnected.length === 0 ? "" : `No frame shows these sheets beside another one: ${unconnected.join(", ")}.`;
        show({ "stitch-unconnected": missing });
    }
}
