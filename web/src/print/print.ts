// The "Print" view: selects a sheet, shows a preview and makes the PDF.
import type { Code } from "dotpose";
import { drawCorner, drawPage } from "../draw/sheet.js";
import type { Engine } from "../engine/engine.js";
import type { SheetChoice, SheetLayout } from "../engine/messages.js";
import { download, element, make, show } from "../page/dom.js";
import type { View } from "../page/view.js";
import { forget, freshOrigin, knownSheets, remember } from "./known_sheets.js";

const kCornerCells = 24;

export class PrintView implements View {
    readonly #engine: Engine;
    readonly #form = element("print-form", HTMLFormElement);
    readonly #name = element("print-name", HTMLInputElement);
    readonly #x = element("print-x", HTMLInputElement);
    readonly #y = element("print-y", HTMLInputElement);
    #layout: SheetLayout | undefined;
    #symbols: Uint8Array = new Uint8Array();

    constructor(engine: Engine) {
        this.#engine = engine;
        this.#form.addEventListener("input", () => void this.#update());
        this.#form.addEventListener("submit", (event) => {
            event.preventDefault();
            void this.#print();
        });
        element("print-fresh", HTMLButtonElement).addEventListener("click", () => this.#takeFresh());
    }

    async shown(): Promise<void> {
        if (this.#layout === undefined) this.#takeFresh();
        this.#listSheets();
        await this.#update();
    }
    hidden(): void {}
    redraw(): void {
        if (!this.#layout) return;
        drawPage(element("print-page", HTMLCanvasElement), this.#layout);
        drawCorner(element("print-corner", HTMLCanvasElement), this.#layout, this.#symbols, kCornerCells);
    }

    #choice(): SheetChoice {
        const value = (id: string) => (document.getElementById(id) as HTMLInputElement | HTMLSelectElement).value;
        let [width_mm, height_mm] = value("print-paper").split("x").map(Number) as [number, number];
        if (element("print-landscape", HTMLInputElement).checked) [width_mm, height_mm] = [height_mm, width_mm];
        return {
            code: value("print-code") as Code,
            section: { u: 0, v: 0 },
            origin: { x: Number(this.#x.value), y: Number(this.#y.value) },
            ...{ width_mm, height_mm, margin_mm: Number(value("print-margin")) },
        };
    }

    #takeFresh(): void {
        const { x, y } = freshOrigin();
        this.#x.value = String(x);
        this.#y.value = String(y);
        void this.#update();
    }

    async #update(): Promise<boolean> {
        try {
            this.#layout = await this.#engine.layout(this.#choice());
            const columns = Math.min(kCornerCells, this.#layout.columns);
            this.#symbols = await this.#engine.symbols({ ...this.#layout, columns, rows: columns });
            const { columns: all, rows } = this.#layout;
            show({ "print-status": `${(all * rows).toLocaleString("en")} dots, ${all} x ${rows}, 0.508 mm apart.` });
            this.redraw();
            return true;
        } catch (error) {
            show({ "print-status": `This sheet cannot be printed: ${error instanceof Error ? error.message : String(error)}.` });
            return false;
        }
    }

    async #print(): Promise<void> {
        if (!(await this.#update())) return;
        const layout = this.#layout!;
        const name = this.#name.value.trim() || "sheet";
        show({ "print-status": "Making the PDF …" });
        // Loads the PDF library only when needed, because it is larger than the rest of the page.
        const { sheetPdf } = await import("./pdf.js");
        const bytes = await sheetPdf(layout, await this.#engine.symbols(layout), name);
        download(`${name.replace(/[^\w-]+/g, "-")}.pdf`, "application/pdf", bytes);
        remember({ name, layout });
        this.#listSheets();
        show({ "print-status": `The PDF of “${name}” is made. Print it at 100 %, “actual size”.` });
    }

    #listSheets(): void {
        const sheets = knownSheets();
        element("print-sheets", HTMLElement).hidden = sheets.length === 0;
        element("print-list", HTMLElement).replaceChildren(
            ...sheets.map(({ name, layout }) => {
                const { origin, columns, rows, width_mm, height_mm, code } = layout;
                const text = `${width_mm} x ${height_mm} mm, cells ${origin.x}, ${origin.y} to ${origin.x + columns - 1}, ${origin.y + rows - 1}, ${code}`;
                const button = make("button", { type: "button" }, "Forget");
                button.setAttribute("aria-label", `Forget the sheet ${name}`);
                button.addEventListener("click", () => {
                    forget(name);
                    this.#listSheets();
                    this.#name.focus();
                });
                const about = make("span", { className: "quiet" }, text);
                return make("li", {}, make("span", {}, make("strong", {}, name), " ", about), button);
            }),
        );
    }
}
