// Draws thousands of robots by copying the pixels of their marks. Without a graphics processor, this takes a tenth of
// the time needed to fill paths. Positions are rounded to whole pixels.
import { themed } from "../draw/surface.js";
import { addMark, kDrawingOrder, kSquare, paintMarks, paintSquares, radiusFor } from "./marks.js";
import { kConditions, type Positions } from "./messages.js";
import type { Viewport } from "./viewport.js";

/** Number of headings for which marks are prepared. Headings are rounded to the nearest of these. */
const kHeadings = 64;
const kFirstHeading = kConditions.length;
const kSquareMark = kFirstHeading + kHeadings;
const kMarks = kSquareMark + 1;

/**
 * Blends a pixel over an opaque pixel. The highest byte is the opacity, because machines that run browsers are
 * little-endian.
 */
function blend(over: number, under: number): number {
    const opacity = over >>> 24;
    const rest = 255 - opacity;
    const red_blue = (((over & 0xff00ff) * opacity + (under & 0xff00ff) * rest) >>> 8) & 0xff00ff;
    const green = (((over & 0xff00) * opacity + (under & 0xff00) * rest) >>> 8) & 0xff00;
    return 0xff000000 | red_blue | green;
}

/** Visible pixels of a mark, with their positions relative to the centre of the mark. */
interface Mark {
    x: Int8Array;
    y: Int8Array;
    pixels: Uint32Array;
}

/** Returns the visible pixels of a square canvas. */
function markOf(context: CanvasRenderingContext2D, size: number): Mark {
    const all = new Uint32Array(context.getImageData(0, 0, size, size).data.buffer);
    const visible = [...all.keys()].filter((i) => all[i]! >>> 24 !== 0);
    const half = Math.floor(size / 2);
    return {
        x: Int8Array.from(visible, (i) => (i % size) - half),
        y: Int8Array.from(visible, (i) => Math.floor(i / size) - half),
        pixels: Uint32Array.from(visible, (i) => all[i]!),
    };
}

export class MarkPixels {
    #ground = new Uint32Array(0);
    #image: ImageData | null = null;
    #pixels = new Uint32Array(0);
    /** A mark for each condition, a mark for each heading of a moving robot, and the square for unknown robots. */
    #marks: Mark[] = [];
    /** Scale, radius and colour for which `#marks` were drawn. */
    #look = "";

    /** Sets the background for the robots. The canvas must be opaque. `scale` is the number of canvas pixels per unit
     * of the viewport. */
    setGround(context: CanvasRenderingContext2D, scale: number, count: number): void {
        const { width, height } = context.canvas;
        this.#ground = new Uint32Array(context.getImageData(0, 0, width, height).data.buffer);
        this.#image = new ImageData(width, height);
        this.#pixels = new Uint32Array(this.#image.data.buffer);
        const look = [scale, radiusFor(count), themed("--accent")].join(" ");
        if (look !== this.#look) this.#drawMarks(scale, radiusFor(count));
        this.#look = look;
    }

    /** Draws the background and the robots. */
    draw(context: CanvasRenderingContext2D, positions: Positions, view: Viewport, scale: number): void {
        if (this.#image === null) return;
        this.#pixels.set(this.#ground);
        const sign = view.y_up ? -1 : 1;
        const moving = kConditions.indexOf("moving");
        for (const condition of kDrawingOrder) {
            const index = kConditions.indexOf(condition);
            for (let i = 0; i < positions.count; ++i) {
                if (positions.condition(i) !== index) continue;
                let mark = index;
                if (index === moving && positions.hasHeading(i)) {
                    const turns = (sign * positions.heading_rad(i)) / (2 * Math.PI);
                    mark = kFirstHeading + (Math.round(turns * kHeadings) & (kHeadings - 1));
                }
                this.#copy(this.#marks[mark]!, scale * view.x(positions.x_mm(i)), scale * view.y(positions.y_mm(i)));
            }
        }
        for (let i = 0; i < positions.count; ++i)
            if (positions.isUnknown(i)) this.#copy(this.#marks[kSquareMark]!, scale * view.x(positions.x_mm(i)), scale * view.y(positions.y_mm(i)));
        context.putImageData(this.#image, 0, 0);
    }

    #drawMarks(scale: number, r: number): void {
        const size = 2 * Math.ceil(scale * (kSquare * r + 1)) + 1;
        const canvas = document.createElement("canvas");
        Object.assign(canvas, { width: size, height: size });
        const context = canvas.getContext("2d", { willReadFrequently: true })!;
        this.#marks = Array.from({ length: kMarks }, (_, mark) => {
            const heading = mark - kFirstHeading;
            context.setTransform(1, 0, 0, 1, 0, 0);
            context.clearRect(0, 0, size, size);
            context.setTransform(scale, 0, 0, scale, size / 2, size / 2);
            context.beginPath();
            if (mark === kSquareMark) {
                context.rect(-kSquare * r, -kSquare * r, 2 * kSquare * r, 2 * kSquare * r);
                paintSquares(context);
            } else {
                const condition = kConditions[mark] ?? "moving";
                addMark(context, condition, 0, 0, heading < 0 ? null : (2 * Math.PI * heading) / kHeadings, r);
                paintMarks(context, condition);
            }
            return markOf(context, size);
        });
    }

    /** Copies the part of a mark that is on the canvas. The mark is centred at (x, y). */
    #copy(mark: Mark, x: number, y: number): void {
        const { width, height } = this.#image!;
        const [xs, ys, marked, pixels] = [mark.x, mark.y, mark.pixels, this.#pixels];
        const left = Math.floor(x);
        const top = Math.floor(y);
        for (let i = 0; i < marked.length; ++i) {
            const [column, row] = [left + xs[i]!, top + ys[i]!];
            if (column < 0 || column >= width || row < 0 || row >= height) continue;
            const pixel = marked[i]!;
            const at = row * width + column;
            pixels[at] = pixel >>> 24 === 255 ? pixel : blend(pixel, pixels[at]!);
        }
    }
}
