// Forms for editing the selected sheet and for adding sheets.
import { element, make, show } from "../page/dom.js";
import { showAnswer, type SheetCommands } from "./sheets_commands.js";
import { wrapped_deg } from "./sheets_geometry.js";
import type { Answer, Sheet } from "./sheets_messages.js";

/** An input field for one number of the sheet. A number typed by the user is not overwritten until it is saved. */
class NumberField {
    readonly #input: HTMLInputElement;
    #saved = NaN;
    #shown = "";

    constructor(id: string) {
        this.#input = element(id, HTMLInputElement);
    }

    /** Shows a value from the file, unless the user has typed another number. */
    show(value: number | null): void {
        const is_typed = this.is_typed;
        this.#saved = value ?? NaN;
        this.#shown = value === null ? "" : String(+value.toFixed(4));
        if (!is_typed) this.#input.value = this.#shown;
    }

    reset(): void {
        this.#input.value = this.#shown;
    }

    get is_typed(): boolean {
        return this.#input.value !== this.#shown;
    }

    /** The number in the field, or the saved number with all its digits if the user has not changed it. */
    get value(): number {
        return this.is_typed ? Number(this.#input.value) : this.#saved;
    }
}

function fact(name: string, value: string): HTMLElement {
    return make("div", {}, make("dt", { textContent: name }), make("dd", { textContent: value }));
}

/** Shows a download link for a file, and starts the download. */
function offer(id: string, { url }: Answer): void {
    const link = element(id, HTMLAnchorElement);
    const file = url.slice(url.lastIndexOf("/") + 1);
    Object.assign(link, { href: url, download: file, hidden: false, textContent: file });
    link.click();
}

export class SheetForms {
    readonly #commands: SheetCommands;
    readonly #select: (name: string) => void;
    readonly #name = element("rename-name", HTMLInputElement);
    readonly #place = { x: new NumberField("place-x"), y: new NumberField("place-y"), yaw: new NumberField("place-yaw") };
    readonly #offset = { right: new NumberField("offset-right"), below: new NumberField("offset-below") };
    #sheet: Sheet | undefined;
    /** Revision of the sheet when the user began to type. */
    #revision = 0;

    constructor(commands: SheetCommands, select: (name: string) => void) {
        this.#commands = commands;
        this.#select = select;
        this.#onSubmit("rename-form", () => this.#rename());
        element("sheet-remove", HTMLButtonElement).addEventListener("click", async () => this.#change("sheet-remove", {}));
        this.#onSubmit("place-form", () => this.#savePlace());
        this.#onSubmit("scale-form", () => this.#saveScale());
        this.#onSubmit("offset-form", () => this.#saveOffset());
        element("place-remove", HTMLButtonElement).addEventListener("click", async () => this.#change("sheet-unplace", {}));
        element("sheet-reprint", HTMLButtonElement).addEventListener("click", async () => {
            const sheet = this.#sheet;
            if (sheet) this.#print("sheet-pdf", "sheet-reprint", { name: sheet.name });
        });
        this.#onSubmit("new-sheet", async () => {
            const spacing_mm = element("new-spacing", HTMLInputElement).valueAsNumber;
            const landscape = element("new-landscape", HTMLInputElement).checked;
            const paper = element("new-paper", HTMLSelectElement).value;
            const answer = await this.#print("new-pdf", "sheet-print", { name: element("new-name", HTMLInputElement).value.trim(), paper, landscape, spacing_mm });
            if (answer.is_ok) select(answer.name);
        });
    }

    /** Shows a sheet. If `sheet` is undefined, shows that no sheet is selected. */
    show(sheet: Sheet | undefined, may_edit: boolean): void {
        const is_other = sheet?.name !== this.#sheet?.name;
        this.#sheet = sheet;
        element("sheet-selected", HTMLElement).hidden = !sheet;
        element("sheet-none", HTMLElement).hidden = sheet !== undefined;
        show({ "sheet-name": sheet?.name ?? "No sheet is selected" });
        for (const form of document.querySelectorAll<HTMLInputElement>("#sheet button, #sheet input, #sheet select, #new-sheet button, #new-sheet input, #new-sheet select"))
            form.disabled = !may_edit;
        if (!sheet) return;
        if (is_other) element("sheet-pdf", HTMLAnchorElement).hidden = true;
        if (is_other) this.#name.value = sheet.name;
        const { world } = sheet;
        element("place-remove", HTMLButtonElement).disabled = !may_edit || !world;
        element("sheet-reprint", HTMLButtonElement).disabled = !may_edit || (sheet.print?.document ?? "") !== "";
        // Keeps the old revision while there are unsaved values. If someone else changes the sheet in the meantime, the
        // server refuses the first save, and the user sees the change.
        if (is_other || ![...Object.values(this.#place), ...Object.values(this.#offset)].some(({ is_typed }) => is_typed)) this.#revision = sheet.revision;
        this.#fill([this.#place.x, this.#place.y, this.#place.yaw], [world?.x_mm ?? null, world?.y_mm ?? null, world?.yaw_deg ?? null], is_other);
        this.#fill([this.#offset.right, this.#offset.below], [sheet.first_x_mm, sheet.first_y_mm], is_other);
        show({ "scale-now": `Now x ${+sheet.scale_x.toFixed(6)}, y ${+sheet.scale_y.toFixed(6)}. Measure a long distance, such as the ruler in the margin.` });
        element("sheet-facts", HTMLDListElement).replaceChildren(...this.#facts(sheet));
    }

    #fill(fields: readonly NumberField[], values: readonly (number | null)[], is_other: boolean): void {
        fields.forEach((field, i) => {
            if (is_other) field.reset();
            field.show(values[i]!);
        });
    }

    #facts(sheet: Sheet): HTMLElement[] {
        const [x, y] = sheet.origin;
        const facts = [
            fact("page", `${sheet.width_mm} × ${sheet.height_mm} mm`),
            fact("dots", `${sheet.columns} × ${sheet.rows}, spacing ${+sheet.spacing_mm.toFixed(4)} mm, ${sheet.code}`),
            fact("cells", `from ${x}, ${y}`),
        ];
        if (sheet.is_reserved) facts.push(fact("state", "reserved: being printed, or the print was stopped. Print it again to use it."));
        if (sheet.print) facts.push(fact("print", `page ${sheet.page} of ${sheet.print.pages} of “${sheet.print.title}”, ${sheet.print.dpi} dpi`));
        if (sheet.print?.command) facts.push(fact("command", sheet.print.command));
        return facts;
    }

    #onSubmit(id: string, act: () => Promise<unknown>): void {
        element(id, HTMLFormElement).addEventListener("submit", (event) => {
            event.preventDefault();
            void act();
        });
    }

    async #change(command: string, values: Record<string, string | number>): Promise<Answer | undefined> {
        const sheet = this.#sheet;
        if (!sheet) return undefined;
        const answer = await this.#commands.send(command, { name: sheet.name, revision: this.#revision, ...values });
        this.#revision = this.#sheet?.revision ?? 0;
        showAnswer(answer);
        return answer;
    }

    async #rename(): Promise<void> {
        const answer = await this.#change("sheet-rename", { new_name: this.#name.value.trim() });
        if (answer?.is_ok) this.#select(answer.name);
    }

    async #savePlace(): Promise<void> {
        const { x, y, yaw } = this.#place;
        const yaw_deg = yaw.is_typed ? wrapped_deg(yaw.value) : yaw.value;
        const answer = await this.#change("sheet-place", { x_mm: x.value, y_mm: y.value, yaw_deg });
        if (answer?.is_ok) for (const field of [x, y, yaw]) field.reset();
    }

    async #saveScale(): Promise<void> {
        const measured = element("scale-measured", HTMLInputElement);
        const nominal_mm = element("scale-nominal", HTMLInputElement).valueAsNumber;
        const along = element("scale-along", HTMLSelectElement).value;
        const answer = await this.#change("sheet-scale", { measured_mm: measured.valueAsNumber, nominal_mm, along });
        if (answer?.is_ok) measured.value = "";
    }

    async #saveOffset(): Promise<void> {
        const { right, below } = this.#offset;
        const answer = await this.#change("sheet-offset", { right_mm: right.value, below_mm: below.value });
        if (answer?.is_ok) for (const field of [right, below]) field.reset();
    }

    async #print(link: string, command: string, values: Record<string, string | number | boolean>): Promise<Answer> {
        const answer = await this.#commands.send(command, values);
        if (answer.is_ok) offer(link, answer);
        showAnswer(answer);
        return answer;
    }
}
