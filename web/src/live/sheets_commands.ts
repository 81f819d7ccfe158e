// Sends sheet commands, and shows the answers.
import { element, show } from "../page/dom.js";
import type { Connection, Value } from "./connection.js";
import type { Answer } from "./sheets_messages.js";

type Arguments = Record<string, string | number | boolean>;

export class SheetCommands {
    readonly #connection: Connection;
    readonly #waiting = new Map<string, (answer: Answer) => void>();
    readonly #prefix = crypto.getRandomValues(new Uint32Array(2)).join("-");
    #sent = 0;

    constructor(connection: Connection) {
        this.#connection = connection;
        connection.subscribe("sheet-answers", (value: Value) => {
            const { answers } = JSON.parse(value as string) as { answers: Answer[] };
            for (const answer of answers) this.#take(answer);
        });
    }

    /** Sends a command. Returns its answer. */
    send(command: string, values: Arguments = {}): Promise<Answer> {
        const id = `${this.#prefix}-${++this.#sent}`;
        return new Promise((resolve) => {
            this.#waiting.set(id, resolve);
            if (!this.#connection.send({ ...values, do: command, id })) this.disconnected();
        });
    }

    /**
     * Called when the connection breaks. Treats all commands that have not been answered as failed, because their
     * answers would not arrive over a new connection.
     */
    disconnected(): void {
        for (const id of [...this.#waiting.keys()])
            this.#take({
                id,
                is_ok: false,
                message: "The connection to dotpose was lost. The sheets show whether the change was saved.",
                name: "",
                url: "",
            });
    }

    #take(answer: Answer): void {
        const resolve = this.#waiting.get(answer.id);
        this.#waiting.delete(answer.id);
        resolve?.(answer);
    }
}

let hiding: ReturnType<typeof setTimeout> | undefined;

/** Shows the result of a command. The reason for a refusal remains visible until the next result. */
export function showAnswer({ is_ok, message }: Pick<Answer, "is_ok" | "message">): void {
    const shown = element("sheets-message", HTMLElement);
    shown.hidden = message === "";
    const kShown_ms = 8000;
    clearTimeout(hiding);
    if (is_ok) hiding = setTimeout(() => (shown.hidden = true), kShown_ms);
    shown.classList.toggle("done", is_ok);
    show({ "sheets-message": is_ok ? message : `Refused: ${message}` });
}
