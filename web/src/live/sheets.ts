// The "Sheets" view: a map and a list of all sheets, and the properties of the selected sheet.
import { element, make, show } from "../page/dom.js";
import type { Connection, Value } from "./connection.js";
import type { Line, Setup } from "./messages.js";
import { SheetCommands, showAnswer } from "./sheets_commands.js";
import { size } from "./sheets_drawing.js";
import { SheetForms } from "./sheets_forms.js";
import { SheetsMap } from "./sheets_map.js";
import type { Pose, Sheet, SheetFile } from "./sheets_messages.js";
import { Stitching } from "./sheets_stitching.js";
import type { LiveView } from "./views.js";

function placeText(pose: Pose | null): string {
    return pose ? `${pose.x_mm.toFixed(1)}, ${pose.y_mm.toFixed(1)} mm, ${pose.yaw_deg.toFixed(1)}°` : "not known";
}

function printText(sheet: Sheet): string {
    if (sheet.is_reserved) return "reserved: being printed, or the print was stopped";
    if (!sheet.print) return "settings are not known";
    return sheet.print.document === "" ? `printed for ${sheet.print.dpi} dpi` : `printed over ${sheet.print.document}`;
}

export class SheetsView implements LiveView {
    readonly #commands: SheetCommands;
    readonly #map: SheetsMap;
    readonly #forms: SheetForms;
    readonly #stitching: Stitching;
    readonly #undo = element("sheets-undo", HTMLButtonElement);
    readonly #redo = element("sheets-redo", HTMLButtonElement);
    #file: SheetFile | null = null;
    #selected = "";

    constructor(connection: Connection) {
        this.#commands = new SheetCommands(connection);
        this.#map = new SheetsMap({
            select: (name) => this.#select(name),
            place: async (sheet, pose) => {
                const answer = await this.#commands.send("sheet-place", { name: sheet.name, revision: sheet.revision, ...pose });
                showAnswer(answer);
                return answer.is_ok;
            },
        });
        this.#forms = new SheetForms(this.#commands, (name) => this.#select(name));
        this.#stitching = new Stitching(connection, this.#commands);
        this.#undo.addEventListener("click", async () => showAnswer(await this.#commands.send("sheet-undo")));
        this.#redo.addEventListener("click", async () => showAnswer(await this.#commands.send("sheet-redo")));
        addEventListener("keydown", (event) => this.#key(event));
        connection.subscribe("sheets", async (value: Value) => {
            this.#take(JSON.parse(value as string) as SheetFile);
            await new Promise(requestAnimationFrame);
        });
    }

    setUp(setup: Setup): void {
        element("sheets-content", HTMLElement).hidden = !setup.has_sheet_file;
        this.#showNotice(setup.has_sheet_file);
    }

    takeLine(line: Line): void {
        const is_on = typeof line.sheet === "string" && typeof line.x_sheet_mm === "number";
        this.#map.takeRobot(
            is_on ? { sheet: line.sheet!, x_mm: line.x_sheet_mm!, y_mm: line.y_sheet_mm!, theta_deg: line.theta_sheet_deg! } : null,
        );
    }

    disconnected(): void {
        this.#commands.disconnected();
    }

    redraw(): void {
        this.#map.redraw();
    }

    #take(file: SheetFile): void {
        this.#file = file;
        this.#showNotice(true);
        this.#map.take(file.sheets, file.may_edit);
        this.#stitching.enable(file.may_edit, file.sheets.length);
        this.#showList();
        element("sheets-keys", HTMLElement).hidden = !file.may_edit;
        for (const [button, what, name] of [[this.#undo, file.undo, "Undo"], [this.#redo, file.redo, "Redo"]] as const) {
            button.disabled = what === "" || !file.may_edit;
            button.title = what;
            button.setAttribute("aria-label", what === "" ? name : `${name}: ${what}`);
        }
        this.#select(file.sheets.some(({ name }) => name === this.#selected) ? this.#selected : "");
    }

    #showNotice(has_sheet_file: boolean): void {
        const texts: string[] = [];
        if (!has_sheet_file) texts.push("This run has no sheet file. Start dotpose watch with --sheets FILE, and with --web-edit-sheets to change it here.");
        if (this.#file?.problem) texts.push(`The sheet file cannot be read now: ${this.#file.problem}. The page shows it as it was before.`);
        if (this.#file && !this.#file.may_edit) texts.push("This page only shows the sheets. Start dotpose watch with --web-edit-sheets to change, print and measure them here.");
        element("sheets-notice", HTMLElement).hidden = texts.length === 0;
        show({ "sheets-notice": texts.join(" ") });
    }

    #select(name: string): void {
        this.#selected = name;
        this.#map.select(name);
        for (const row of element("sheets-list", HTMLTableSectionElement).rows) {
            const is_this = row.dataset["name"] === name;
            row.classList.toggle("selected", is_this);
            row.querySelector("button")?.setAttribute("aria-pressed", String(is_this));
        }
        this.#forms.show(this.#file?.sheets.find((sheet) => sheet.name === name), this.#file?.may_edit ?? false);
    }

    #showList(): void {
        const { sheets, not_shown } = this.#file!;
        const focused = document.activeElement?.closest<HTMLElement>("#sheets-list tr")?.dataset["name"];
        const rows = sheets.map((sheet) => {
            const button = make("button", { type: "button", textContent: sheet.name, className: "link" });
            button.addEventListener("click", () => this.#select(sheet.name));
            const cells = [make("td", {}, button), ...[size(sheet), placeText(sheet.world), printText(sheet)].map((text) => make("td", { textContent: text }))];
            const row = make("tr", {}, ...cells);
            row.dataset["name"] = sheet.name;
            return row;
        });
        element("sheets-list", HTMLTableSectionElement).replaceChildren(...rows);
        rows.find((row) => focused !== undefined && row.dataset["name"] === focused)?.querySelector("button")?.focus();
        element("sheets-more", HTMLElement).hidden = not_shown === 0;
        show({ "sheets-more": `${not_shown} further sheets are not shown; dotpose sheets list shows all.` });
        show({ "sheets-title": `Sheets in the world: ${sheets.filter(({ world }) => world).length} of ${sheets.length} have a place` });
    }

    /** Handles Ctrl-Z and Ctrl-Y, except in an input field, where they undo and redo typing. */
    #key(event: KeyboardEvent): void {
        const is_hidden = element("view-sheets", HTMLElement).hidden;
        if (is_hidden || event.target instanceof HTMLInputElement || !(event.ctrlKey || event.metaKey)) return;
        const key = event.key.toLowerCase();
        const button = key === "y" || (key === "z" && event.shiftKey) ? this.#redo : key === "z" ? this.#undo : null;
        if (!button) return;
        event.preventDefault();
        button.click();
    }
}
