// Shows the chosen robot: its newest state, its path and its history, and the button that removes it.
import type { Connection } from "../live/connection.js";
import { element, make, show } from "../page/dom.js";
import { length } from "../page/format.js";
import type { Alert, Robot } from "./messages.js";
import { age, change, kNothing, number, place, symbolOf, time } from "./texts.js";

function refusedText({ camera }: Robot): string {
    const refused = Object.entries(camera?.refused ?? {}).sort((a, b) => b[1] - a[1]);
    if (camera === undefined) return kNothing;
    if (refused.length === 0) return `none of ${camera.frames}`;
    return `${refused.map(([reason, count]) => `${count} ${reason.replaceAll("_", " ")}`).join(", ")}, of ${camera.frames}`;
}

function spaceText({ space }: Robot): string {
    if (space === undefined) return kNothing;
    return `${space.height_mm.toFixed(3)} mm high, tilted by ${space.tilt_deg.toFixed(2)}°`;
}

export function eventItem(event: Alert, ...name: (string | Node)[]): HTMLLIElement {
    const item = make("li", {}, make("time", { textContent: time(event.time_us) }), ...name, make("span", { textContent: change(event) }));
    item.className = event.state;
    return item;
}

export class RobotPanel {
    readonly #connection: Connection;
    readonly #panel = element("fleet-robot", HTMLElement);
    readonly #dialog = element("fleet-removal", HTMLDialogElement);
    readonly #changed: (robot: Robot | null) => void;
    #id: number | null = null;
    #robot: Robot | null = null;
    #listed = "";
    #reveals = false;

    /** `changed` is called with each new state of the chosen robot. `find` is called when the user asks to see the
     * robot on the map. */
    constructor(connection: Connection, changed: (robot: Robot | null) => void, find: (robot: Robot) => void) {
        this.#connection = connection;
        this.#changed = changed;
        element("fleet-close", HTMLButtonElement).addEventListener("click", () => this.choose(null));
        element("fleet-find", HTMLButtonElement).addEventListener("click", () => this.#robot && find(this.#robot));
        element("fleet-remove", HTMLButtonElement).addEventListener("click", () => this.#dialog.showModal());
        element("fleet-keep", HTMLButtonElement).addEventListener("click", () => this.#dialog.close());
        element("fleet-remove-now", HTMLButtonElement).addEventListener("click", () => this.#remove());
    }

    get id(): number | null {
        return this.#id;
    }

    request(): Record<string, number> {
        return this.#id === null ? {} : { robot: this.#id };
    }

    /** Chooses a robot. If `reveal` is true, scrolls to the panel when it is shown. */
    choose(id: number | null, reveal = false): void {
        this.#id = id;
        this.#reveals = reveal;
        element("fleet-robot-in-space", HTMLElement).hidden = true;
        if (id === null) this.take(null);
        this.#connection.ask("robot", this.request());
    }

    take(robot: Robot | null): void {
        if (robot !== null && robot.id !== this.#id) return;
        if (robot === null && this.#robot !== null) this.#id = null;
        this.#robot = robot;
        this.#panel.hidden = robot === null;
        if (robot === null && this.#dialog.open) this.#dialog.close();
        if (robot !== null) this.#show(robot);
        if (robot !== null && this.#reveals) this.#panel.scrollIntoView({ block: "nearest" });
        if (robot !== null) this.#reveals = false;
        this.#changed(robot);
    }

    #show(robot: Robot): void {
        const is_fine = robot.state === "moving" || robot.state === "still";
        element("fleet-robot-state", HTMLElement).className = is_fine ? `hint good ${robot.state}` : "hint";
        show({
            "fleet-robot-name": robot.name,
            "fleet-removed-name": robot.name,
            "fleet-robot-state": `${symbolOf(robot.state)} ${robot.state}${robot.reason ? `: ${robot.reason}` : ""}`,
            "fleet-robot-place": place(robot) + (robot.is_known ? "" : " (not in the sheet file)"),
            "fleet-robot-x": number(robot.x_mm, 3),
            "fleet-robot-y": number(robot.y_mm, 3),
            "fleet-robot-angle": robot.theta_deg === undefined ? kNothing : `${robot.theta_deg.toFixed(2)}°`,
            "fleet-robot-speed": robot.speed_mm_s === undefined ? kNothing : `${robot.speed_mm_s.toFixed(1)} mm/s`,
            "fleet-robot-sigma": robot.deviation_mm === undefined ? kNothing : length(robot.deviation_mm),
            "fleet-robot-age": age(robot.age_s),
            "fleet-robot-messages": String(robot.messages),
            "fleet-robot-missed": robot.missed === undefined ? kNothing : String(robot.missed),
            "fleet-robot-camera": number(robot.camera?.rate_hz, 1),
            "fleet-robot-refused": refusedText(robot),
            "fleet-robot-space": spaceText(robot),
        });
        if (robot.space) element("fleet-robot-in-space", HTMLElement).hidden = false;
        element("fleet-find", HTMLButtonElement).disabled = robot.map === undefined;
        const text = JSON.stringify([robot.id, robot.events]);
        if (text === this.#listed) return;
        this.#listed = text;
        element("fleet-robot-events", HTMLUListElement).replaceChildren(...robot.events.map((event) => eventItem(event)));
        element("fleet-no-events", HTMLElement).hidden = robot.events.length > 0;
    }

    #remove(): void {
        if (this.#robot !== null) this.#connection.send({ do: "remove", robot: this.#robot.id, name: this.#robot.name });
        this.#dialog.close();
    }
}
