// The part of a map that the canvas shows.

export interface Bounds_mm {
    x_min: number;
    x_max: number;
    y_min: number;
    y_max: number;
}

/** Returns the smallest bounds that contain both bounds. */
export function union(a: Bounds_mm | null, b: Bounds_mm | null): Bounds_mm | null {
    if (a === null || b === null) return a ?? b;
    return {
        x_min: Math.min(a.x_min, b.x_min),
        x_max: Math.max(a.x_max, b.x_max),
        y_min: Math.min(a.y_min, b.y_min),
        y_max: Math.max(a.y_max, b.y_max),
    };
}

export function boundsOf(points: readonly (readonly [number, number])[]): Bounds_mm {
    const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
    return { x_min: Math.min(...xs), x_max: Math.max(...xs), y_min: Math.min(...ys), y_max: Math.max(...ys) };
}

export function touches(a: Bounds_mm, b: Bounds_mm): boolean {
    return a.x_min <= b.x_max && b.x_min <= a.x_max && a.y_min <= b.y_max && b.y_min <= a.y_max;
}

/** Minimum and maximum scale, in px per mm. */
const kMinScale = 1e-6;
const kMaxScale = 50;
/** Minimum extent that `fit` shows. */
const kMinExtent_mm = 50;
const kMargin_px = 24;

export class Viewport {
    width = 1;
    height = 1;
    /** True if y points up, as in the world. */
    y_up = true;
    #x_mm = 0;
    #y_mm = 0;
    #scale = 1;

    get scale(): number {
        return this.#scale;
    }

    fit(bounds: Bounds_mm): void {
        const columns = Math.max(this.width - 2 * kMargin_px, 1) / Math.max(bounds.x_max - bounds.x_min, kMinExtent_mm);
        const rows = Math.max(this.height - 2 * kMargin_px, 1) / Math.max(bounds.y_max - bounds.y_min, kMinExtent_mm);
        this.#setScale(Math.min(columns, rows));
        this.centre((bounds.x_min + bounds.x_max) / 2, (bounds.y_min + bounds.y_max) / 2);
    }

    centre(x_mm: number, y_mm: number): void {
        this.#x_mm = x_mm;
        this.#y_mm = y_mm;
    }

    drag(dx: number, dy: number): void {
        this.#x_mm -= dx / this.#scale;
        this.#y_mm -= (dy / this.#scale) * (this.y_up ? -1 : 1);
    }

    /** Multiplies the shown extent by a factor. */
    zoom(factor: number): void {
        this.#setScale(this.#scale / factor);
    }

    #setScale(scale: number): void {
        this.#scale = Math.min(Math.max(scale, kMinScale), kMaxScale);
    }

    readonly x = (x_mm: number) => this.width / 2 + (x_mm - this.#x_mm) * this.#scale;
    readonly y = (y_mm: number) => this.height / 2 + (y_mm - this.#y_mm) * (this.y_up ? -1 : 1) * this.#scale;

    /** Returns the bounds of the shown part of the map, with a margin for marks that are partly visible. */
    bounds(): Bounds_mm {
        const half_x = (this.width / 2 + kMargin_px) / this.#scale;
        const half_y = (this.height / 2 + kMargin_px) / this.#scale;
        return {
            x_min: this.#x_mm - half_x,
            x_max: this.#x_mm + half_x,
            y_min: this.#y_mm - half_y,
            y_max: this.#y_mm + half_y,
        };
    }
}
