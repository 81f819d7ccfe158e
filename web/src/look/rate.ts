/** Measures the frame rate over the last second. */
export class Rate {
    #times_ms: number[] = [];

    restart(): void {
        this.#times_ms = [];
    }

    /** Counts a frame and returns the current number of frames per second. */
    count(): number {
        const now_ms = performance.now();
        this.#times_ms.push(now_ms);
        while (now_ms - this.#times_ms[0]! > 1000) this.#times_ms.shift();
        const passed_ms = now_ms - this.#times_ms[0]!;
        return passed_ms === 0 ? 0 : Math.round((1000 * (this.#times_ms.length - 1)) / passed_ms);
    }
}
