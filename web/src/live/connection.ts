// The WebSocket to the program. The program sends the newest value of each topic, and sends the next value only after
// the page has shown the previous one. A slow page or connection therefore receives fewer values rather than outdated
// values.

export type Value = string | Uint8Array<ArrayBuffer>;
export type Show = (value: Value) => Promise<void> | void;
export type Request = Record<string, string | number | boolean>;

const kRetry_ms = 1000;
const kNewline = 10;

function split(data: string | ArrayBuffer): [string, Value] {
    if (typeof data === "string") {
        const end = data.indexOf("\n");
        return [data.slice(0, end), data.slice(end + 1)];
    }
    const bytes = new Uint8Array(data);
    const end = bytes.indexOf(kNewline);
    return [new TextDecoder().decode(bytes.subarray(0, end)), bytes.subarray(end + 1)];
}

export class Connection {
    readonly #topics = new Map<string, { show: Show; request: Request }>();
    readonly #changed: (is_open: boolean) => void;
    #socket: WebSocket | undefined;

    /** `changed` is called when the connection opens or breaks. */
    constructor(changed: (is_open: boolean) => void) {
        this.#changed = changed;
    }

    /** Connects, and reconnects whenever the connection breaks. */
    open(): void {
        const scheme = location.protocol === "https:" ? "wss" : "ws";
        const socket = new WebSocket(`${scheme}://${location.host}/live`);
        socket.binaryType = "arraybuffer";
        socket.onopen = () => {
            this.#changed(true);
            for (const [topic, { request }] of this.#topics) this.send({ ...request, do: "subscribe", topic });
        };
        socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => void this.#take(data);
        socket.onclose = () => {
            this.#changed(false);
            setTimeout(() => this.open(), kRetry_ms);
        };
        this.#socket = socket;
    }

    /** Subscribes to a topic. Its values may depend on the request. */
    subscribe(topic: string, show: Show, request: Request = {}): void {
        this.#topics.set(topic, { show, request });
        this.send({ ...request, do: "subscribe", topic });
    }

    /** Changes the request for a subscribed topic. The server then sends a value for the new request. */
    ask(topic: string, request: Request): void {
        const subscribed = this.#topics.get(topic);
        if (subscribed !== undefined) this.subscribe(topic, subscribed.show, request);
    }

    unsubscribe(topic: string): void {
        this.#topics.delete(topic);
        this.send({ do: "unsubscribe", topic });
    }

    /** Sends a command. Returns false if there is no connection. */
    send(command: Request): boolean {
        if (this.#socket?.readyState !== WebSocket.OPEN) return false;
        this.#socket.send(JSON.stringify(command));
        return true;
    }

    async #take(data: string | ArrayBuffer): Promise<void> {
        const [topic, value] = split(data);
        try {
            await this.#topics.get(topic)?.show(value);
        } finally {
            if (this.#topics.has(topic)) this.send({ do: "next", topic });
        }
    }
}
