// Controls for the pose in space in the "Look" view. They set the camera's focal length or load a
// camera file.
import { fitsCamera } from "../engine/camera_size.js";
import type { PageCamera, Reading } from "../engine/messages.js";
import { element, show } from "../page/dom.js";
import { SpacePanel } from "../page/space_panel.js";
import { cameraOfFile } from "./camera_file.js";

const kMaxFocal_px = 1e6;

function stateOf(camera: PageCamera | null, file: string): string {
    if (camera === null) return "With a focal length, height and tilt of the camera are shown, too.";
    if (camera.size_px === null) return "A lens without distortion, with its axis through the image centre.";
    return `${file}, for ${camera.size_px.join(" x ")} px`;
}

export class SpaceControls {
    readonly #focal = element("look-focal", HTMLInputElement);
    readonly #panel = new SpacePanel("look");
    #camera: PageCamera | null = null;
    /** Name of the camera file. Empty if only the focal length was entered. */
    #file = "";

    /**
     * `changed` is called after the user has changed the camera. `say` shows a message to the user.
     */
    constructor(
        private readonly changed: () => void,
        private readonly say: (text: string) => void,
    ) {
        this.#focal.addEventListener("change", () => this.#enter());
        element("look-camera-file", HTMLInputElement).addEventListener("change", (event) => {
            const input = event.target as HTMLInputElement;
            void this.#read(input.files?.[0]);
            input.value = "";
        });
    }

    /** The camera, or null if no pose in space is wanted. */
    get camera(): PageCamera | null {
        return this.#camera;
    }

    showReading({ fix }: Reading): void {
        if (this.#camera === null) return this.#panel.hide();
        const { space } = fix;
        const pose = space && {
            height_mm: -space.position_mm[2],
            quaternion_xyzw: space.quaternion_xyzw,
            covariance: space.covariance,
        };
        this.#panel.show({ pose, source: space?.is_ambiguous ? "another tilt is possible" : "", is_in_world: false });
    }

    /** Returns the reason why a frame has no pose in space, or null if the frame has the image size of the camera. */
    complaintOf({ width_px, height_px }: Reading): string | null {
        if (this.#camera === null || fitsCamera(this.#camera, width_px, height_px)) return null;
        const file = this.#camera.size_px!.join(" x ");
        return `No pose in space: '${this.#file}' is for images of ${file} px, and this one has ${width_px} x ${height_px} px.`;
    }

    #set(camera: PageCamera | null, file: string): void {
        this.#camera = camera;
        this.#file = file;
        show({ "look-camera-state": stateOf(camera, file) });
        this.say("");
        this.changed();
    }

    #enter(): void {
        const { value } = this.#focal;
        const focal_px = Number(value);
        const is_valid = value === "" ? !this.#focal.validity.badInput : focal_px >= 1 && focal_px <= kMaxFocal_px;
        this.#focal.setCustomValidity(is_valid ? "" : "The focal length must be from 1 to 1,000,000 px.");
        if (!is_valid) return this.say(`${this.#focal.validationMessage}`);
        const simple = { size_px: null, axis_px: [0, 0], lens_k_per_px2: 0, centre_px: [0, 0] } as const;
        this.#set(value === "" ? null : { ...simple, focal_px: [focal_px, focal_px] }, "");
    }

    async #read(file: File | undefined): Promise<void> {
        if (!file) return;
        try {
            const camera = cameraOfFile(await file.text());
            this.#focal.value = String(Math.round(10 * Math.sqrt(camera.focal_px[0] * camera.focal_px[1])) / 10);
            this.#focal.setCustomValidity("");
            this.#set(camera, file.name);
        } catch (error) {
            this.say(`'${file.name}' is not read as a camera file: ${error instanceof Error ? error.message : String(error)}.`);
        }
    }
}
