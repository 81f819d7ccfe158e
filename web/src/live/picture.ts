// Shows the camera's frame with its overlay, and the aids for focus and exposure.
import { drawFrame } from "../draw/frame.js";
import { measureQuality } from "../engine/quality.js";
import type { ImageQuality } from "../engine/messages.js";
import { element, show } from "../page/dom.js";
import { hintOfPicture } from "../page/hints.js";
import type { Connection, Value } from "./connection.js";
import { frameOf, type LiveFrame } from "./messages.js";

const kLarge = "frame";
const kSmall = "small-frame";
/** Length of the longer side of small frames. */
const kSmall_px = 480;
/** Minimum rate of large frames. If the rate is lower, small frames are requested. */
const kMinRate_hz = 3;
const kMeasured_ms = 4000;

/** Measures the quality of a frame from its picture. */
class Meter {
    readonly #canvas = new OffscreenCanvas(1, 1);
    /**
     * Maximum edge steepness so far. Each frame's steepness is compared with this maximum to show how much the focus
     * can be improved. The sharpness is unsuitable, because noise makes it high in frames without dots.
     */
    #best = 0;

    measure({ picture }: LiveFrame): ImageQuality {
        const { width, height } = picture;
        if (this.#canvas.width !== width || this.#canvas.height !== height) Object.assign(this.#canvas, { width, height });
        const context = this.#canvas.getContext("2d", { willReadFrequently: true })!;
        context.drawImage(picture, 0, 0);
        const pixels = context.getImageData(0, 0, width, height).data;
        const data = new Uint8Array(width * height);
        for (let i = 0; i < data.length; ++i) data[i] = pixels[4 * i]!;
        return measureQuality({ data, width, height });
    }

    /** Shows the quality of a frame in which `dots` dots were found. */
    show(quality: ImageQuality, dots: number): void {
        this.#best = Math.max(this.#best, quality.steepness);
        element("live-brightness", HTMLMeterElement).value = quality.brightness;
        element("live-contrast", HTMLMeterElement).value = quality.contrast;
        const fraction = quality.steepness / Math.max(this.#best, 1);
        element("live-sharpness", HTMLMeterElement).value = fraction;
        show({
            "live-brightness-text": `${Math.round(quality.brightness)} of 255`,
            "live-contrast-text": `${Math.round(quality.contrast)} grey levels`,
            "live-sharpness-text": `${Math.round(100 * fraction)} % of the best`,
            "live-picture-advice": hintOfPicture(quality, dots) ?? "The picture is bright and sharp enough.",
        });
    }

    /** Resets the maximum steepness, for example after the lens has been changed. */
    restart(): void {
        this.#best = 0;
    }
}

export class Picture {
    readonly #connection: Connection;
    readonly #canvas = element("live-frame", HTMLCanvasElement);
    readonly #layers = element("live-layers", HTMLInputElement);
    readonly #meter = new Meter();
    #topic = "";
    #last: LiveFrame | undefined;
    #times_ms: number[] = [];
    #is_slow = false;
    readonly #drawMore: () => void;

    /** `drawMore` is called after a frame has been drawn, to draw on top of it. */
    constructor(connection: Connection, drawMore = () => {}) {
        this.#connection = connection;
        this.#drawMore = drawMore;
        this.#layers.addEventListener("change", () => this.redraw());
        element("live-refocus", HTMLButtonElement).addEventListener("click", () => this.#meter.restart());
        document.addEventListener("visibilitychange", () => this.request());
        this.request();
    }

    /**
     * Requests large or small frames, depending on the displayed size and on the frame rate. Requests none while the
     * page or the picture is hidden.
     */
    request(): void {
        const shown_px = this.#canvas.clientWidth * window.devicePixelRatio;
        const wanted = document.hidden || shown_px === 0 ? "" : this.#is_slow || shown_px <= kSmall_px ? kSmall : kLarge;
        if (wanted === this.#topic) return;
        if (this.#topic !== "") this.#connection.unsubscribe(this.#topic);
        this.#topic = wanted;
        this.#times_ms = [];
        if (wanted !== "") this.#connection.subscribe(wanted, (value) => this.#take(value));
    }

    redraw(): void {
        if (this.#last === undefined) return;
        const is_on = this.#layers.checked;
        drawFrame(this.#canvas, this.#last, { found: is_on, grid: is_on, pose: is_on });
        this.#drawMore();
    }

    async #take(value: Value): Promise<void> {
        const frame = await frameOf(value as Uint8Array<ArrayBuffer>);
        this.#last?.picture.close();
        this.#last = frame;
        this.#meter.show(this.#meter.measure(frame), frame.overlay.dots.length / 2);
        this.redraw();
        this.#countRate();
        // The next frame is requested after this frame is on the screen.
        await new Promise(requestAnimationFrame);
    }

    #countRate(): void {
        const now_ms = performance.now();
        this.#times_ms.push(now_ms);
        while (now_ms - this.#times_ms[0]! > kMeasured_ms) this.#times_ms.shift();
        const passed_s = (now_ms - this.#times_ms[0]!) / 1000;
        // The rate is not shown in the first second, because two frames that are queued at the beginning arrive
        // together.
        const rate_hz = passed_s > 1 ? (this.#times_ms.length - 1) / passed_s : 0;
        show({ "live-frame-rate": rate_hz > 0 ? `shown: ${rate_hz.toFixed(0)} frames/s` : "" });
        if (this.#topic !== kLarge || now_ms - this.#times_ms[0]! < kMeasured_ms / 2 || rate_hz >= kMinRate_hz) return;
        this.#is_slow = true;
        this.request();
    }
}
