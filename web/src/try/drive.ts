// Drives the simulated camera automatically until the user moves it.
import type { SheetLayout } from "../engine/messages.js";
import { element } from "../page/dom.js";
import type { SimulatedCamera } from "./camera.js";

const kSpeed_mm_s = 9;

/** Drives the camera over the page in wide curves. */
export class Drive {
    sheet: SheetLayout | undefined;
    readonly #button = element("try-drive", HTMLButtonElement);
    #is_on = false;
    #is_paused = true;
    #phase = 0;
    #last_ms = 0;

    constructor(
        private readonly camera: SimulatedCamera,
        private readonly moved: () => void,
    ) {
        this.#button.addEventListener("click", () => (this.#is_on ? this.stop() : this.#start()));
        // If the user prefers reduced motion, the drive starts only when the button is clicked.
        if (!matchMedia("(prefers-reduced-motion: reduce)").matches) this.#set(true);
    }

    stop(): void {
        this.#set(false);
    }
    pause(): void {
        this.#is_paused = true;
    }
    resume(): void {
        if (!this.#is_paused) return;
        this.#is_paused = false;
        if (this.#is_on) this.#start();
    }

    #set(is_on: boolean): void {
        this.#is_on = is_on;
        this.#button.setAttribute("aria-pressed", String(is_on));
        this.#button.textContent = is_on ? "Stop driving" : "Drive automatically";
    }

    #start(): void {
        this.#set(true);
        this.#last_ms = performance.now();
        requestAnimationFrame((now_ms) => this.#step(now_ms));
    }

    #step(now_ms: number): void {
        if (!this.#is_on || this.#is_paused || !this.sheet) return;
        const kMaxStep_s = 0.1;
        const step_s = Math.min(Math.max(0, now_ms - this.#last_ms) / 1000, kMaxStep_s);
        this.#last_ms = now_ms;
        this.#phase += step_s;
        this.camera.turnBy(24 * Math.sin(this.#phase / 3) * step_s);
        this.#homewards(step_s);
        const heading_rad = this.camera.theta_rad;
        this.camera.moveTo(
            this.camera.x_mm + kSpeed_mm_s * step_s * Math.cos(heading_rad),
            this.camera.y_mm + kSpeed_mm_s * step_s * Math.sin(heading_rad),
            this.sheet,
        );
        this.moved();
        requestAnimationFrame((next_ms) => this.#step(next_ms));
    }

    /** Turns the camera towards the centre before it reaches the edge of the page. */
    #homewards(step_s: number): void {
        const kKeepAway_mm = 25;
        const { width_mm, height_mm } = this.sheet!;
        const { x_mm, y_mm, theta_rad } = this.camera;
        const edge_mm = Math.min(x_mm, y_mm, width_mm - x_mm, height_mm - y_mm);
        if (edge_mm > kKeepAway_mm) return;
        const home_rad = Math.atan2(height_mm / 2 - y_mm, width_mm / 2 - x_mm);
        this.camera.turnBy(90 * step_s * Math.sign(Math.sin(home_rad - theta_rad)));
    }
}
