// Interface between the page and the worker, with one function per request.
import type {
    Answer,
    LumaPath,
    Reading,
    ReadOptions,
    Request,
    SheetChoice,
    SheetLayout,
    SimulatedView,
} from "./messages.js";

/** Events from a stream of camera frames. */
export interface StreamEvents {
    onFrame(reading: Reading, path: LumaPath): void;
    onEnd(message: string): void;
}

interface Waiting {
    resolve(value: unknown): void;
    reject(error: Error): void;
}

type WithoutId<T> = T extends { id: number } ? Omit<T, "id"> : never;

export class Engine {
    readonly #worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
    readonly #waiting = new Map<number, Waiting>();
    #last_id = 0;
    #events: StreamEvents | undefined;
    /** True if the worker can read the video track of a camera directly. */
    takesTracks = false;

    constructor() {
        this.#worker.onmessage = ({ data }: MessageEvent<Answer>) => this.#hear(data);
        this.#worker.onerror = (event) => {
            for (const { reject } of this.#waiting.values()) reject(new Error(event.message));
            this.#waiting.clear();
        };
    }

    layout(sheet: SheetChoice): Promise<SheetLayout> {
        return this.#ask({ kind: "layout", sheet });
    }
    symbols(sheet: SheetLayout): Promise<Uint8Array> {
        return this.#ask({ kind: "symbols", sheet });
    }
    simulate(sheet: SheetChoice, view: SimulatedView, options: ReadOptions): Promise<Reading> {
        return this.#ask({ kind: "simulate", sheet, view, options });
    }
    /** Reads a picture. The picture is transferred to the worker and returned in the reading. */
    read(picture: ImageBitmap, options: ReadOptions, time_s: number): Promise<Reading> {
        return this.#ask({ kind: "picture", picture, options, time_s }, [picture]);
    }

    /** Starts reading frames from a stream, or from a track if `takesTracks` is true. */
    follow(source: ReadableStream<VideoFrame> | MediaStreamTrack, options: ReadOptions, events: StreamEvents): void {
        this.#events = events;
        if (source instanceof ReadableStream) {
            this.#notify({ kind: "stream", frames: source, options }, [source]);
        } else {
            this.#notify({ kind: "track", track: source, options }, [source as unknown as Transferable]);
        }
    }
    /** Requests the next frame of the stream. */
    next(): void {
        this.#notify({ kind: "next" });
    }
    stop(): void {
        this.#events = undefined;
        this.#notify({ kind: "stop" });
    }

    #notify(request: Request, transfer: Transferable[] = []): void {
        this.#worker.postMessage(request, transfer);
    }

    #ask<T>(request: WithoutId<Request>, transfer: Transferable[] = []): Promise<T> {
        const id = ++this.#last_id;
        return new Promise<T>((resolve, reject) => {
            this.#waiting.set(id, { resolve: (value) => resolve(value as T), reject });
            this.#notify({ ...request, id } as Request, transfer);
        });
    }

    #hear(answer: Answer): void {
        switch (answer.kind) {
            case "ready":
                this.takesTracks = answer.processor;
                return;
            case "frame":
                if (this.#events) this.#events.onFrame(answer.reading, answer.path);
                else answer.reading.picture.close();
                return;
            case "ended":
                this.#events?.onEnd(answer.message);
                return;
            case "result":
                this.#waiting.get(answer.id)?.resolve(answer.value);
                break;
            case "failed":
                this.#waiting.get(answer.id)?.reject(new Error(answer.message));
                break;
        }
        this.#waiting.delete(answer.id);
    }
}
