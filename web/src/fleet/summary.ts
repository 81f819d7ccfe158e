// Shows the numbers of robots and messages, and the alerts of all robots.
import { element, make, show } from "../page/dom.js";
import { kSymbols } from "./marks.js";
import { kConditions, type Summary } from "./messages.js";
import { eventItem } from "./robot.js";
import { change } from "./texts.js";

function storeText(store: Summary["store"]): string {
    if (store === null) return "";
    const dropped = store.dropped > 0 ? `, ${store.dropped} dropped` : "";
    return `; database: ${store.is_away ? "away, " : ""}${store.stored} stored, ${store.waiting} waiting${dropped}`;
}

export class SummaryView {
    readonly #announce: (text: string) => void;
    #listed = "";
    #newest_us: number | null = null;

    constructor(announce: (text: string) => void, showOnly: (state: string) => void) {
        this.#announce = announce;
        const chips = [...kConditions, "unknown", "all"] as const;
        for (const name of chips)
            element(`fleet-chip-${name}`, HTMLButtonElement).addEventListener("click", () => showOnly(name));
    }

    take(summary: Summary): void {
        for (const state of kConditions) show({ [`fleet-chip-${state}`]: `${kSymbols[state]} ${summary.states[state]} ${state}` });
        const [median_ms, p99_ms] = summary.latency_ms;
        const missed = summary.missed === undefined ? "" : `${summary.missed} missed, `;
        show({
            "fleet-chip-all": `${summary.robots} robot${summary.robots === 1 ? "" : "s"}`,
            "fleet-chip-unknown": `□ ${summary.unknown} on unknown sheets`,
            "fleet-rate": `${summary.states_per_s.toFixed(0)} states/s`,
            "fleet-counts":
                `${summary.messages} states, ${missed}${summary.late} late, ${summary.repeated} repeated, ${summary.bad} bad messages; ` +
                `latency median ${median_ms.toFixed(1)} ms, 99 % ${p99_ms.toFixed(1)} ms${storeText(summary.store)}`,
        });
        element("fleet-chip-unknown", HTMLButtonElement).hidden = summary.unknown === 0;
        element("fleet-broker", HTMLElement).hidden = summary.is_broker_connected;
        this.#list(summary.alerts);
    }

    #list(alerts: Summary["alerts"]): void {
        const text = JSON.stringify(alerts);
        if (text === this.#listed) return;
        this.#listed = text;
        element("fleet-alerts", HTMLUListElement).replaceChildren(
            ...alerts.map((alert) => eventItem(alert, make("b", { textContent: alert.robot }))),
        );
        element("fleet-no-alerts", HTMLElement).hidden = alerts.length > 0;
        const newest = alerts[0];
        if (newest !== undefined && this.#newest_us !== null && newest.time_us > this.#newest_us)
            this.#announce(`${newest.robot}: ${change(newest)}`);
        this.#newest_us = newest?.time_us ?? 0;
    }
}
