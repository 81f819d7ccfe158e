// Runs the locator, the simulated camera and the loop over camera frames in a worker, to keep the page responsive.
import { Locator, patternBits, type Fix, type Image, type LocatorOptions } from "dotpose";
import { fitsCamera } from "./camera_size.js";
import { cellsInView } from "./cells.js";
import { lumaByCanvas, lumaOfFrame } from "./luma.js";
import { measureQuality } from "./quality.js";
import { layoutOf, render } from "./simulator.js";
import type { Answer, LumaPath, Reading, ReadOptions, Request, SheetLayout } from "./messages.js";

const port = self as unknown as {
    postMessage(message: Answer, transfer?: Transferable[]): void;
    onmessage: ((event: MessageEvent<Request>) => void) | null;
};

/** The locator used for the newest reading. `key` contains its options as JSON. */
let current: { key: string; locator: Promise<Locator> } | undefined;
let previous: Fix | null = null;

/** Returns the locator options for images of this size. */
function locatorOptions({ camera, ...options }: ReadOptions, width: number, height: number): LocatorOptions {
    if (!camera || !fitsCamera(camera, width, height)) return options;
    if (!camera.size_px) return { ...options, space: { focal_px: camera.focal_px } };
    const [u, v] = camera.centre_px;
    return {
        ...options,
        lens_k_per_px2: camera.lens_k_per_px2,
        lens_centre_offset_px: [u - (width - 1) / 2, v - (height - 1) / 2],
        space: { focal_px: camera.focal_px, axis_px: camera.axis_px },
    };
}

/** Returns a locator for an image. Creates a new one if the options have changed. */
function locatorFor({ width, height }: Image, options: ReadOptions): Promise<Locator> {
    const used = locatorOptions(options, width, height);
    const key = JSON.stringify(used);
    if (current?.key !== key) {
        current = { key, locator: Locator.create({ ...used, dots: true }) };
        previous = null;
    }
    return current.locator;
}

async function read(
    image: Image,
    picture: ImageBitmap,
    options: ReadOptions,
    time_s: number,
): Promise<Reading> {
    const locator = await locatorFor(image, options);
    const begin = performance.now();
    const fix = locator.locate(image, { prediction: previous });
    const locate_ms = performance.now() - begin;
    previous = fix.ok ? fix : null;
    const { width, height } = image;
    const [quality, cells] = [measureQuality(image), await cellsInView(fix, width, height)];
    return { fix, picture, width_px: width, height_px: height, quality, cells, locate_ms, time_s };
}

function greyPicture({ data, width, height }: Image): Promise<ImageBitmap> {
    const rgba = new Uint8ClampedArray(4 * width * height).fill(255);
    for (let i = 0; i < width * height; ++i) rgba.fill(data[i]!, 4 * i, 4 * i + 3);
    return createImageBitmap(new ImageData(rgba, width, height));
}

/**
 * A stream of camera frames, read one at a time. The next frame is read after the page has drawn
 * the previous frame.
 */
class Stream {
    #reader: ReadableStreamDefaultReader<VideoFrame>;
    #wanted: () => void = () => {};
    #stopped = false;

    constructor(
        frames: ReadableStream<VideoFrame>,
        private readonly options: ReadOptions,
    ) {
        this.#reader = frames.getReader();
    }

    next(): void {
        this.#wanted();
    }
    stop(): void {
        this.#stopped = true;
        void this.#reader.cancel();
        this.#wanted();
    }

    async run(): Promise<void> {
        while (!this.#stopped) {
            const { value: frame, done } = await this.#reader.read();
            if (done || frame === undefined) break;
            const asked = new Promise<void>((resolve) => (this.#wanted = resolve));
            const { reading, path } = await this.#readAndClose(frame);
            port.postMessage({ kind: "frame", reading, path }, [reading.picture]);
            await asked;
        }
        if (!this.#stopped) port.postMessage({ kind: "ended", message: "The camera stopped." });
    }

    async #readAndClose(frame: VideoFrame): Promise<{ reading: Reading; path: LumaPath }> {
        try {
            const { image, path } = await lumaOfFrame(frame);
            const picture = await createImageBitmap(frame);
            return { reading: await read(image, picture, this.options, frame.timestamp / 1e6), path };
        } finally {
            frame.close();
        }
    }
}

let stream: Stream | undefined;

function startStream(frames: ReadableStream<VideoFrame>, options: ReadOptions): void {
    stream?.stop();
    previous = null;
    stream = new Stream(frames, options);
    stream.run().catch((error: unknown) => port.postMessage({ kind: "ended", message: String(error) }));
}

function symbolsOf(sheet: SheetLayout): Promise<Uint8Array> {
    const { code, section, origin: cell, columns, rows } = sheet;
    return patternBits({ code, section, cell, columns, rows });
}

type Asked = Extract<Request, { id: number }>;

async function answer(request: Asked): Promise<[value: unknown, transfer: Transferable[]]> {
    switch (request.kind) {
        case "layout":
            return [await layoutOf(request.sheet), []];
        case "symbols": {
            const symbols = await symbolsOf(request.sheet);
            return [symbols, [symbols.buffer]];
        }
        case "simulate": {
            const image = await render(request.sheet, request.view);
            const reading = await read(image, await greyPicture(image), request.options, 0);
            return [reading, [reading.picture]];
        }
        case "picture": {
            const { picture, options, time_s } = request;
            const image = lumaByCanvas(picture, picture.width, picture.height);
            const reading = await read(image, picture, options, time_s);
            return [reading, [picture]];
        }
    }
}

async function reply(request: Asked): Promise<void> {
    try {
        const [value, transfer] = await answer(request);
        port.postMessage({ kind: "result", id: request.id, value }, transfer);
    } catch (error) {
        const message = error instanceof Error ? error.message : String(error);
        port.postMessage({ kind: "failed", id: request.id, message });
    }
}

type Processor = new (init: { track: MediaStreamTrack }) => { readable: ReadableStream<VideoFrame> };
const { MediaStreamTrackProcessor: Processor } = self as { MediaStreamTrackProcessor?: Processor };

port.onmessage = ({ data: request }) => {
    switch (request.kind) {
        case "stream":
            return startStream(request.frames, request.options);
        case "track":
            return startStream(new Processor!({ track: request.track }).readable, request.options);
        case "next":
            return stream?.next();
        case "stop":
            stream?.stop();
            stream = undefined;
            return;
        default:
            void reply(request);
    }
};
port.postMessage({ kind: "ready", processor: Processor !== undefined });
