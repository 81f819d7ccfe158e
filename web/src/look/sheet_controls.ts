// Controls for the known sheets in the "Look" view.
import type { Fix } from "dotpose";
import type { ReadOptions } from "../engine/messages.js";
import { element, show } from "../page/dom.js";
import type { SheetContext } from "../page/hints.js";
import { knownSheets, regionOf, rememberAll, sheetUnder, type KnownSheet } from "../print/known_sheets.js";
import { sheetsOfFile } from "../print/sheet_file.js";

export class SheetControls {
    readonly #only = element("look-only", HTMLInputElement);
    #sheets: KnownSheet[] = [];

    /**
     * `changed` is called after the user has changed the options. `say` shows a message to the user.
     */
    constructor(
        private readonly changed: () => void,
        private readonly say: (text: string) => void,
    ) {
        this.#only.addEventListener("change", () => this.changed());
        element("look-sheets", HTMLInputElement).addEventListener("change", (event) => {
            const input = event.target as HTMLInputElement;
            void this.#read(input.files?.[0]);
            input.value = "";
        });
    }

    /** Reloads the list of known sheets, which other views can change. */
    refresh(): void {
        this.#sheets = knownSheets();
        const count = this.#sheets.length;
        this.#only.disabled = count === 0;
        if (count === 0) this.#only.checked = false;
        show({ "look-known": count === 0 ? "No known sheets" : count === 1 ? "1 known sheet" : `${count} known sheets` });
    }

    get options(): ReadOptions {
        return { sheets: this.#sheets.map(({ layout }) => regionOf(layout)), only_sheets: this.#only.checked };
    }
    /** Returns the context of a frame. `sheet` is the known sheet that contains its fix, or null. */
    contextOf(sheet: KnownSheet | null): SheetContext {
        return { is_on_unknown: this.#sheets.length > 0 && sheet === null, only_sheets: this.#only.checked };
    }
    /** Returns the known sheet that contains a fix, or null if there is none. */
    under(fix: Fix): KnownSheet | null {
        return sheetUnder(fix, this.#sheets);
    }

    async #read(file: File | undefined): Promise<void> {
        if (!file) return;
        try {
            rememberAll(sheetsOfFile(await file.text()));
            this.say("");
            this.refresh();
            this.changed();
        } catch (error) {
            this.say(`'${file.name}' is not read as a sheet file: ${error instanceof Error ? error.message : String(error)}.`);
        }
    }
}
