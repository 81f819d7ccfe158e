// Passes frames from the camera of the phone or computer to the worker.
import type { Engine, StreamEvents } from "../engine/engine.js";
import type { ReadOptions } from "../engine/messages.js";

type Processor = new (init: { track: MediaStreamTrack }) => { readable: ReadableStream<VideoFrame> };

/** Method for reading frames. `?luma=canvas` in the address forces the canvas, which every browser supports. */
const kForced = new URLSearchParams(location.search).get("luma");

/**
 * Starts the camera `device`. If `device` is empty, starts any camera, preferably the back camera of a phone. `size_px`
 * is the preferred image size.
 */
export async function openCamera(device: string, size_px: readonly [number, number]): Promise<MediaStream> {
    const which = device === "" ? { facingMode: { ideal: "environment" } } : { deviceId: { exact: device } };
    const video = { ...which, width: { ideal: size_px[0] }, height: { ideal: size_px[1] } };
    return navigator.mediaDevices.getUserMedia({ video, audio: false });
}

/**
 * Returns the cameras with their names. Browsers reveal the names only after the user has allowed
 * access to a camera.
 */
export async function listCameras(): Promise<{ id: string; name: string }[]> {
    const devices = await navigator.mediaDevices.enumerateDevices();
    return devices
        .filter(({ kind }) => kind === "videoinput")
        .map(({ deviceId, label }, i) => ({ id: deviceId, name: label || `Camera ${i + 1}` }));
}

/** Reads the frames of a video element through a canvas, for browsers without a track processor. */
class VideoLoop {
    #is_stopped = false;
    #resume: (() => void) | undefined;

    constructor(
        private readonly engine: Engine,
        private readonly video: HTMLVideoElement,
        private readonly options: ReadOptions,
        private readonly events: StreamEvents,
    ) {}

    next(): void {
        this.#resume?.();
    }
    stop(): void {
        this.#is_stopped = true;
        this.#resume?.();
    }

    async run(): Promise<void> {
        await this.video.play();
        while (!this.#is_stopped) {
            const time_s = await this.#nextFrame();
            if (this.#is_stopped) return;
            const picture = await createImageBitmap(this.video);
            const reading = await this.engine.read(picture, this.options, time_s);
            const drawn = new Promise<void>((resolve) => (this.#resume = resolve));
            this.events.onFrame(reading, "canvas");
            await drawn;
        }
    }

    #nextFrame(): Promise<number> {
        return new Promise((resolve) => {
            this.#resume = () => resolve(0);
            if ("requestVideoFrameCallback" in this.video)
                this.video.requestVideoFrameCallback((_now, { mediaTime }) => resolve(mediaTime));
            else requestAnimationFrame(() => resolve((this.video as HTMLVideoElement).currentTime));
        });
    }
}

/** A running camera. */
export class CameraFrames {
    #loop: VideoLoop | undefined;

    constructor(
        private readonly engine: Engine,
        private readonly stream: MediaStream,
    ) {}

    start(video: HTMLVideoElement, options: ReadOptions, events: StreamEvents): void {
        const track = this.stream.getVideoTracks()[0]!;
        track.addEventListener("ended", () => events.onEnd("The camera stopped."));
        const { MediaStreamTrackProcessor: Processor } = self as { MediaStreamTrackProcessor?: Processor };
        if (kForced !== "canvas" && Processor !== undefined) {
            this.engine.follow(new Processor({ track }).readable, options, events);
        } else if (kForced !== "canvas" && this.engine.takesTracks) {
            this.engine.follow(track.clone(), options, events);
        } else {
            video.srcObject = this.stream;
            this.#loop = new VideoLoop(this.engine, video, options, events);
            this.#loop.run().catch((error: unknown) => events.onEnd(String(error)));
        }
    }

    /** Requests the next frame. Called after the previous frame has been drawn. */
    next(): void {
        if (this.#loop) this.#loop.next();
        else this.engine.next();
    }

    stop(): void {
        this.#loop?.stop();
        this.engine.stop();
        for (const track of this.stream.getTracks()) track.stop();
    }
}
