// WorkerLocator: a Locator that runs in a worker.
import type { Fix } from "./fix.js";
import { compile } from "./instance.js";
import type { FrameOptions, Image, LocatorOptions } from "./locator.js";

/** Result for one image. */
export interface Located {
    /** The pose computed from the image. */
    fix: Fix;
    /** The image that was sent. Its buffer can be reused. */
    image: Image;
}

interface Answer {
    id: number;
    result?: Located;
    error?: unknown;
}

/**
 * Locates images in a separate worker, which keeps the page responsive. Only for browsers.
 *
 *     const locator = await WorkerLocator.create();
 *     const { fix, image } = await locator.locate({ data, width, height });
 *
 * Images are transferred to the worker rather than copied. `data` is empty until the answer returns
 * the image. Calls are answered in order.
 */
export class WorkerLocator {
    readonly #worker: Worker;
    readonly #waiting = new Map<number, { resolve(result?: Located): void; reject(error: unknown): void }>();
    #last_id = 0;
    #is_closed = false;

    private constructor() {
        this.#worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
        this.#worker.onmessage = ({ data }: MessageEvent<Answer>) => this.#settle(data);
        this.#worker.onerror = (event) => this.#fail(new Error(event.message || "the worker did not start"));
    }

    /** Starts a worker with a locator. Accepts the options of Locator.create. */
    static async create(options: LocatorOptions = {}): Promise<WorkerLocator> {
        const locator = new WorkerLocator();
        try {
            const { wasm } = options;
            // A compiled module can be sent to a worker. A relative URL would be resolved
            // differently in the worker.
            const sent = wasm === undefined ? options : { ...options, wasm: await compile(wasm) };
            await locator.#ask({ kind: "create", options: sent }, []);
        } catch (error) {
            locator.close();
            throw error;
        }
        return locator;
    }

    /**
     * Locates an image. Returns the fix together with the image, whose buffer is transferred to the
     * worker and back.
     */
    async locate(image: Image, options: FrameOptions = {}): Promise<Located> {
        return (await this.#ask({ kind: "locate", image, options }, [image.data.buffer]))!;
    }

    /** Ends the worker, and rejects pending calls. */
    close(): void {
        this.#is_closed = true;
        this.#worker.terminate();
        this.#fail(new Error("the locator was closed"));
    }

    #ask(request: object, transfer: Transferable[]): Promise<Located | undefined> {
        if (this.#is_closed) return Promise.reject(new Error("the locator was closed"));
        const id = ++this.#last_id;
        return new Promise((resolve, reject) => {
            this.#waiting.set(id, { resolve, reject });
            this.#worker.postMessage({ id, ...request }, transfer);
        });
    }

    #settle({ id, result, error }: Answer): void {
        const asked = this.#waiting.get(id);
        this.#waiting.delete(id);
        if (error === undefined) asked?.resolve(result);
        else asked?.reject(error);
    }

    #fail(error: Error): void {
        for (const asked of this.#waiting.values()) asked.reject(error);
        this.#waiting.clear();
    }
}
