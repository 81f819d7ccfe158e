// Sliders and buttons that degrade the simulated frame.
import { element, make } from "../page/dom.js";
import { kPresets, kSliders, type SimulatedCamera } from "./camera.js";

/** Creates the sliders. Returns a function that updates the sliders after other controls have changed the camera. */
export function buildSliders(camera: SimulatedCamera, changed: () => void): () => void {
    const rows = kSliders.map((slider) => {
        const { name, label, min, max, step } = slider;
        const input = make("input", { type: "range", id: `try-${name}` });
        Object.assign(input, { min: String(min), max: String(max), step: String(step) });
        const output = make("output", { htmlFor: input.id } as never);
        const heading = make("label", { htmlFor: input.id }, label);
        element("try-sliders", HTMLElement).append(make("div", { className: "slider" }, heading, output, input));
        input.addEventListener("input", () => {
            camera.conditions[name] = Number(input.value);
            changed();
        });
        return { slider, input, output };
    });
    for (const button of document.querySelectorAll<HTMLButtonElement>("[data-preset]"))
        button.addEventListener("click", () => {
            Object.assign(camera.conditions, kPresets[button.dataset["preset"]!]);
            changed();
        });
    return () => {
        for (const { slider, input, output } of rows) {
            const value = camera.conditions[slider.name];
            const text = slider.shown(value, camera.px);
            if (output.textContent === text) continue;
            input.value = String(value);
            input.setAttribute("aria-valuetext", text);
            output.textContent = text;
        }
    };
}
