// Shows the steps of a calibration. For each step, shows what it determines, what the user must do, and the result.
import { element, make } from "../page/dom.js";
import type { CalibrationState, StepName } from "./calibration_state.js";

export interface Step {
    name: StepName;
    title: string;
    finds: string;
    task: string;
}

export const kSteps: readonly Step[] = [
    {
        name: "lens",
        title: "Lens",
        finds: "Distortion and scale of the camera.",
        task: "Move the camera over a printed sheet and rest for a moment at each place. Show dots in every part of the frame, and turn the camera or the sheet. Tilt a camera that is held by hand. Frames are taken automatically until they suffice.",
    },
    {
        name: "spin",
        title: "Mount (turn on the spot)",
        finds: "Position of the camera on the robot.",
        task: "Let the robot turn slowly on the spot, until it has turned once. The centre of the turn becomes the position that is reported.",
    },
    {
        name: "drive",
        title: "Direction (straight drive)",
        finds: "Direction of the camera on the robot.",
        task: "Let the robot drive straight ahead for 60 mm. Its direction becomes the angle that is reported.",
    },
    {
        name: "readout",
        title: "Readout time (fast drive)",
        finds: "Only for cameras with a rolling shutter: the time from the first to the last row.",
        task: "Let the robot drive fast over the sheet. 40 consecutive frames are taken.",
    },
    {
        name: "pivot",
        title: "Tip of a pen (pivot)",
        finds: "Only for a camera in a pen: position of the tip. Needs a lens with its focal length.",
        task: "Put the tip at one point of the sheet, for example in a small dent, and keep it there. Tilt the pen by up to 40 degrees to all sides. 30 frames with different tilts are taken.",
    },
];

/** Replaces the ASCII notation used in terminal output with typographic characters. */
export function typeset(text: string): string {
    return text.replaceAll("+-", "±").replaceAll("^2", "²");
}

export function stepOf(name: StepName): Step {
    return kSteps.find((step) => step.name === name)!;
}

export class StepList {
    readonly #items = new Map<StepName, { value: HTMLElement; button: HTMLButtonElement; item: HTMLElement }>();

    constructor(start: (step: StepName) => void) {
        const list = element("calibration-steps", HTMLOListElement);
        for (const step of kSteps) {
            const value = make("p", { className: "value" });
            const button = make("button", { type: "button", textContent: "Start", disabled: true });
            button.dataset.step = step.name;
            button.setAttribute("aria-label", `Start: ${step.title}`);
            button.addEventListener("click", () => start(step.name));
            const text = make("div", {}, make("h3", { textContent: step.title }), make("p", { className: "quiet", textContent: step.finds }), value);
            const item = make("li", {}, text, button);
            list.append(item);
            this.#items.set(step.name, { value, button, item });
        }
    }

    /** Shows a state. `state` is null if the program is not permitted to calibrate. */
    show(state: CalibrationState | null): void {
        for (const [name, { value, button, item }] of this.#items) {
            const text = state?.values[name] ?? "";
            value.textContent = text === "" ? "not calibrated" : typeset(text);
            value.classList.toggle("known", text !== "");
            const is_running = state?.phase === "collecting" || state?.phase === "solving";
            // An unsaved result must be saved or discarded before another step begins.
            button.disabled = state === null || is_running || state.phase === "solved";
            item.classList.toggle("current", is_running && state?.step === name);
        }
    }
}
