// Shows refused frames by reason over time, as stacked bars with a legend and a summary in words.
import { surfaceOf, themed } from "../draw/surface.js";
import { element, make, show } from "../page/dom.js";
import type { History } from "./messages.js";

const kShown_s = 120;
/** Colours that are distinguishable with all types of colour vision, on light and dark backgrounds. */
const kInks = ["#d55e00", "#0072b2", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d46", "#7f7f7f"];
const kOk = "ok";

export class Refusals {
    readonly #canvas = element("live-refusals", HTMLCanvasElement);
    readonly #inks = new Map<string, string>();
    #history: History = { seconds: [] };

    take(history: History): void {
        this.#history = history;
        const totals = new Map<string, number>();
        for (const { frames } of history.seconds)
            for (const [reason, count] of Object.entries(frames)) totals.set(reason, (totals.get(reason) ?? 0) + count);
        const all = [...totals.values()].reduce((sum, count) => sum + count, 0);
        const refused = [...totals].filter(([reason]) => reason !== kOk).sort((a, b) => b[1] - a[1]);
        for (const [reason] of refused) this.#inkOf(reason);
        const summary = refused.length === 0 ? "none" : `${all - (totals.get(kOk) ?? 0)} of ${all} frames`;
        show({ "live-refused": `last 2 minutes: ${summary}` });
        element("live-reasons", HTMLUListElement).replaceChildren(
            ...refused.map(([reason, count]) => {
                const mark = make("span", { className: "legend" });
                mark.style.background = this.#inkOf(reason);
                return make("li", {}, mark, `${reason.replaceAll("_", " ")}: ${count}`);
            }),
        );
        this.redraw();
    }

    #inkOf(reason: string): string {
        if (!this.#inks.has(reason)) this.#inks.set(reason, kInks[this.#inks.size % kInks.length]!);
        return this.#inks.get(reason)!;
    }

    /**
     * Draws one bar per second. The height of a bar represents the fraction of frames that were refused in that second.
     */
    redraw(): void {
        const { context, width, height } = surfaceOf(this.#canvas);
        const { seconds } = this.#history;
        const step = width / kShown_s;
        const newest = seconds.at(-1)?.second ?? 0;
        for (const { second, frames } of seconds) {
            const all = Object.values(frames).reduce((sum, count) => sum + count, 0);
            const x = width - (newest - second + 1) * step;
            context.fillStyle = themed("--line");
            context.fillRect(x, height - 2, Math.max(step - 1, 1), 2);
            let y = height;
            for (const [reason, count] of Object.entries(frames)) {
                if (reason === kOk) continue;
                const bar = ((height - 2) * count) / all;
                y -= bar;
                context.fillStyle = this.#inkOf(reason);
                context.fillRect(x, y, Math.max(step - 1, 1), bar);
            }
        }
    }
}
