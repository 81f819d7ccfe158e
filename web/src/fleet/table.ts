// The table of robots. The program sends only the rows that are shown.
import type { Connection } from "../live/connection.js";
import { element, make, show } from "../page/dom.js";
import type { Row, Table } from "./messages.js";
import { age, number, place, symbolOf } from "./texts.js";

const kRows = 25;
const kColumns = 9;

/** A row of the table. Its cells are changed in place, so they keep the focus. */
class ShownRow {
    readonly row = make("tr");
    readonly #name = make("button", { type: "button", className: "link" });
    readonly #cells: HTMLTableCellElement[] = [];
    #id = 0;

    constructor(choose: (id: number) => void) {
        this.#name.addEventListener("click", () => choose(this.#id));
        this.row.append(make("th", { scope: "row" }, this.#name));
        for (let i = 0; i < kColumns; ++i) this.#cells.push(this.row.insertCell());
    }

    show(row: Row, is_chosen: boolean): void {
        this.#id = row.id;
        if (this.#name.textContent !== row.name) this.#name.textContent = row.name;
        this.row.className = is_chosen ? `${row.state} chosen` : row.state;
        const texts = [
            `${symbolOf(row.state)} ${row.state}`,
            row.reason,
            age(row.age_s),
            number(row.x_mm, 1),
            number(row.y_mm, 1),
            number(row.theta_deg, 1),
            number(row.speed_mm_s, 0),
            number(row.missed, 0),
            place(row) + (row.is_known ? "" : " (not in the sheet file)"),
        ];
        texts.forEach((text, i) => {
            if (this.#cells[i]!.textContent !== text) this.#cells[i]!.textContent = text;
        });
    }
}

export class RobotTable {
    readonly #connection: Connection;
    readonly #choose: (id: number) => void;
    readonly #body = element("fleet-rows", HTMLTableSectionElement);
    readonly #filter = element("fleet-filter", HTMLInputElement);
    readonly #show = element("fleet-show", HTMLSelectElement);
    readonly #order = element("fleet-order", HTMLSelectElement);
    readonly #previous = element("fleet-previous", HTMLButtonElement);
    readonly #next = element("fleet-next", HTMLButtonElement);
    readonly #rows: ShownRow[] = [];
    #first = 0;
    #table: Table | null = null;
    #chosen: number | null = null;

    constructor(connection: Connection, choose: (id: number) => void) {
        this.#connection = connection;
        this.#choose = choose;
        for (const control of [this.#filter, this.#show, this.#order]) control.addEventListener("input", () => this.#turn(0));
        this.#previous.addEventListener("click", () => this.#turn(this.#first - kRows));
        this.#next.addEventListener("click", () => this.#turn(this.#first + kRows));
    }

    request(): Record<string, string | number> {
        const kMaxFilter = 100;
        const filter = this.#filter.value.slice(0, kMaxFilter);
        return { filter, show: this.#show.value, order: this.#order.value, first: this.#first, rows: kRows };
    }

    /** Shows only the robots in the given state, and goes to the first row. */
    showOnly(show: string): void {
        this.#filter.value = "";
        this.#show.value = show;
        this.#turn(0);
    }

    take(table: Table): void {
        this.#table = table;
        this.#first = table.first;
        while (this.#rows.length < table.rows.length) this.#rows.push(new ShownRow(this.#choose));
        const shown = this.#rows.slice(0, table.rows.length);
        shown.forEach((row, i) => row.show(table.rows[i]!, table.rows[i]!.id === this.#chosen));
        if (this.#body.rows.length !== shown.length) this.#body.replaceChildren(...shown.map(({ row }) => row));
        const last = table.first + table.rows.length;
        const range = table.matching === 0 ? "no robots" : `${table.first + 1} to ${last} of ${table.matching}`;
        show({ "fleet-range": range });
        this.#previous.disabled = table.first === 0;
        this.#next.disabled = last >= table.matching;
    }

    takeChosen(id: number | null): void {
        this.#chosen = id;
        if (this.#table !== null) this.take(this.#table);
    }

    #turn(first: number): void {
        this.#first = Math.max(first, 0);
        this.#connection.ask("table", this.request());
    }
}
