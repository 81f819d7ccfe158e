// Controls the record button, and offers the recorded files for download.
import { element, make, show } from "../page/dom.js";
import type { Connection } from "./connection.js";
import type { Setup, State } from "./messages.js";

export class Recorder {
    readonly #button = element("live-record", HTMLButtonElement);
    readonly #files = element("live-files", HTMLUListElement);
    #is_on = false;
    #log: string | null = null;
    #listed = "";

    constructor(connection: Connection) {
        this.#button.addEventListener("click", () => connection.send({ do: "record", on: !this.#is_on }));
    }

    setUp(setup: Setup): void {
        this.#log = setup.log;
    }

    take({ recording }: State): void {
        this.#is_on = recording.is_on;
        this.#button.disabled = false;
        this.#button.setAttribute("aria-pressed", String(recording.is_on));
        show({
            "live-record": recording.is_on ? "Stop recording" : "Record",
            "live-recorded": recording.is_on ? `${recording.name}: ${recording.frames} frames` : "",
            "live-notice": recording.notice,
        });
        element("live-notice", HTMLElement).hidden = recording.notice === "";
        this.#list([...(this.#log ? [this.#log] : []), ...recording.files.map((file) => `/recordings/${file}`)]);
    }

    #list(paths: string[]): void {
        if (paths.join() === this.#listed) return;
        this.#listed = paths.join();
        this.#files.replaceChildren(
            ...paths.map((path) => {
                const file = path.slice(path.lastIndexOf("/") + 1);
                return make("li", {}, make("a", { href: path, download: file, textContent: file }));
            }),
        );
        element("live-no-files", HTMLElement).hidden = paths.length > 0;
    }
}
