// Tests the /calibration page of `dotpose watch --web`: a simulated camera on a simulated robot is
// calibrated step by step, and the camera file is compared with the simulated camera.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { requireAccessible } from "./accessible.mjs";
import { takeForms } from "../tools/forms.mjs";
import { dotpose, kTool, launch, open } from "./browser.mjs";

const [kWidth_px, kHeight_px] = [188, 120];
const kSpacing_mm = 0.508;
const kScale_mm_per_px = 0.046;
const kLens_per_px2 = -8.7e-6;
const kCorner_px = Math.hypot(kWidth_px / 2, kHeight_px / 2);
/** Position of the robot's centre relative to the image centre, along the image axes. */
const kMount_mm = { x: 14.5, y: -6.25 };
/** Heading of the robot relative to the image x axis. */
const kHeading_rad = Math.PI / 2;
const kPeriod_ms = 50;
const kReadout_ms = 20;
const kPlace = { x: 5000, y: 7000 };

/** Simulated pen camera. `tip_mm` is the pen's tip in the camera frame: x right, y down, z forward. */
const kPen = { size: "320x240", focal_px: 16 / 0.03, spacing_mm: 0.3, tip_mm: [0.5, 5, 18], rest_mm: 0.1, at_mm: [500, 700] };

let folder;
let browser;
let shots;

/** Renders a frame and returns its pixels. Positions are in grid units. */
function render(name, x, y, angle_deg, ...more) {
    const into = join(folder, "shot", name);
    const scene = ["--frames", "1", "--preset", "clean", "--section", "3,5", "--k", String(kLens_per_px2), "--seed", "3"];
    dotpose("simulate", "-o", into, ...scene, "--at", `${x},${y}`, "--angle", String(angle_deg), ...more);
    return pixelsOf(join(into, "frame_000000.pgm"));
}

function pixelsOf(file, pixels = kWidth_px * kHeight_px) {
    return readFileSync(file).subarray(-pixels);
}

/** Rotates a vector about a unit axis, using Rodrigues' formula. */
function rotated(v, axis, angle) {
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const dot = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
    const cross = [axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2], axis[0] * v[1] - axis[1] * v[0]];
    return v.map((value, i) => value * c + cross[i] * s + axis[i] * dot * (1 - c));
}

/**
 * Renders the view from a pen whose tip rests on a fixed point. The pen is rotated by `turn_deg` and then tilted in the
 * direction `side_deg`.
 */
function pen(index, tilt_deg, side_deg, turn_deg) {
    const [tilt, side, turn] = [tilt_deg, side_deg, turn_deg].map((angle) => (angle * Math.PI) / 180);
    const on_sheet = (v) => rotated(rotated(v, [0, 0, 1], turn), [Math.sin(side), -Math.cos(side), 0], tilt);
    const tip = on_sheet(kPen.tip_mm);
    const axis = on_sheet([0, 0, 1]);
    const distance_mm = (tip[2] + kPen.rest_mm) / axis[2];
    const at = [0, 1].map((i) => (kPen.at_mm[i] - tip[i] + distance_mm * axis[i]) / kPen.spacing_mm);
    // The normal of the paper in the camera frame is (sin ty, -sin tx cos ty, cos tx cos ty).
    const normal = [on_sheet([1, 0, 0])[2], on_sheet([0, 1, 0])[2], axis[2]];
    const tilts = [Math.atan2(-normal[1], normal[2]), Math.asin(normal[0])].map((angle) => (angle * 180) / Math.PI);
    const right = on_sheet([1, 0, -normal[0] / normal[2]]);
    const into = join(folder, "shot", `pen${index}`);
    const scene = ["--frames", "1", "--preset", "clean", "--seed", String(index + 1), "--section", "3,5", "--spacing", String(kPen.spacing_mm)];
    const camera = ["--size", kPen.size, "--mm-per-px", String(distance_mm / kPen.focal_px), "--working-distance", String(distance_mm)];
    const pose = ["--at", at.join(), "--angle", String((Math.atan2(right[1], right[0]) * 180) / Math.PI), "--tilt", tilts.join()];
    dotpose("simulate", "-o", into, ...scene, ...camera, ...pose);
    return pixelsOf(join(into, "frame_000000.pgm"), 320 * 240);
}

/** Frames from a pen that is tilted in all directions, by small, medium and large angles. */
function pivot() {
    const rings = [12, 24, 36].flatMap((tilt_deg, ring) => Array.from({ length: 10 }, (_, i) => [tilt_deg, 36 * i + 12 * ring, 50 * i]));
    return [[0, 0, 0], [3, 90, 120], ...rings].map((tilts, i) => pen(i, ...tilts));
}

/** Frames from a robot that turns on the spot. The robot's centre stays at `kPlace`. */
function turn(steps) {
    return Array.from({ length: steps }, (_, i) => {
        const angle_deg = 7 + (360 / steps) * i;
        const [c, s] = [Math.cos((angle_deg * Math.PI) / 180), Math.sin((angle_deg * Math.PI) / 180)];
        const x = kPlace.x - (c * kMount_mm.x - s * kMount_mm.y) / kSpacing_mm;
        const y = kPlace.y - (s * kMount_mm.x + c * kMount_mm.y) / kSpacing_mm;
        return render(`turn${i}`, x, y, angle_deg);
    });
}

/** Frames from a robot that drives straight ahead. */
function drive(frames, step_mm) {
    const angle_deg = 20;
    const heading = (angle_deg * Math.PI) / 180 + kHeading_rad;
    return Array.from({ length: frames }, (_, i) => {
        const along = (i * step_mm) / kSpacing_mm;
        return render(`drive${i}`, kPlace.x + along * Math.cos(heading), kPlace.y + along * Math.sin(heading), angle_deg);
    });
}

/** Frames from a rolling-shutter camera that moves along its image x axis. */
function fastDrive(frames, step_mm) {
    const readout_px = ((step_mm / kScale_mm_per_px) * kReadout_ms) / kPeriod_ms;
    return Array.from({ length: frames }, (_, i) =>
        render(`fast${i}`, kPlace.x + (i * step_mm) / kSpacing_mm, kPlace.y, 0, "--readout", `${-readout_px},0`),
    );
}

/** 30 frames at random positions and angles. */
function places() {
    const into = join(folder, "places");
    dotpose("simulate", "-o", into, "--frames", "30", "--seed", "5", "--section", "3,5", "--k", String(kLens_per_px2));
    return Array.from({ length: 30 }, (_, i) => pixelsOf(join(into, `frame_${String(i).padStart(6, "0")}.pgm`)));
}

/**
 * Runs `dotpose watch` with its web page. The simulated camera repeats the frames passed in the latest call to `show`.
 */
class Run {
    #frames = [];
    #next = 0;
    #timer;
    /** True if the program reads the frames from its standard input. */
    #reads;

    async start(options, source = ["-", "--size", `${kWidth_px}x${kHeight_px}`, "--fps", String(1000 / kPeriod_ms)]) {
        this.#reads = source[0] === "-";
        const always = ["--web", "0", "--no-window", "-o", "/dev/null"];
        this.program = spawn(kTool, ["watch", ...source, ...always, ...options], { stdio: ["pipe", "ignore", "pipe"] });
        this.program.stdin.on("error", () => {});
        this.messages = "";
        this.ended = new Promise((resolve) => this.program.on("exit", resolve));
        this.url = await new Promise((resolve, reject) => {
            this.program.stderr.on("data", (data) => {
                this.messages += data;
                const found = /the page is at (\S+)/.exec(this.messages);
                if (found) resolve(found[1]);
            });
            this.program.on("exit", () => reject(new Error(this.messages)));
        });
        this.#timer = setInterval(() => this.#write(), kPeriod_ms);
        return this;
    }

    show(frames) {
        [this.#frames, this.#next] = [frames, 0];
    }

    /**
     * Writes the next frame if the program has read all previous frames. On a busy machine, the program may lag behind.
     */
    #write() {
        if (this.#reads && this.#frames.length > 0 && this.program.stdin.writableLength === 0) this.program.stdin.write(this.#frames[this.#next++ % this.#frames.length]);
    }

    /** Ends the program and returns its exit status. */
    async stop() {
        clearInterval(this.#timer);
        this.program.stdin.end();
        if (!this.#reads) this.program.kill("SIGINT");
        return this.ended;
    }
}

function cameraIn(file) {
    const values = {};
    for (const [, key, value] of readFileSync(file, "utf8").matchAll(/^( *[a-z_0-9]+): +([^#\n]*)/gm))
        values[key.trim()] ??= JSON.parse(/^[-[\d]/.test(value) ? value : JSON.stringify(value));
    return values;
}

/** Returns the position of the reference point relative to the image centre. */
function mountOf(camera) {
    const [u, v] = camera.reference_px;
    return { x: (u - (kWidth_px - 1) / 2) * camera.mm_per_px[0], y: (v - (kHeight_px - 1) / 2) * camera.mm_per_px[1] };
}

const titleIs = (text) => document.getElementById("calibration-title").textContent.endsWith(text);

/** Runs a calibration step on `frames`: starts the step, waits for the result, and saves the result. */
async function calibrate(page, run, step, frames) {
    run.show([frames[0]]);
    await page.click(`[data-step=${step}]`);
    await page.waitForFunction(titleIs, ": taking frames");
    run.show(frames);
    await page.waitForFunction(() => !/taking frames|calculating/.test(document.getElementById("calibration-title").textContent));
    const problem = await page.textContent("#calibration-problem");
    assert.equal(problem, "");
    assert.match(await page.textContent("#calibration-title"), /: result$/);
    await page.click("#calibration-save");
    await page.waitForFunction(titleIs, ": saved");
    assert.match(await page.textContent("#calibration-verdict"), /^Saved in \w+\.yaml\. The run uses it\.$/);
    return page.textContent("#calibration-report");
}

before(async () => {
    folder = mkdtempSync(join(tmpdir(), "dotpose-calibration-"));
    mkdirSync(join(folder, "shot"));
    // Each frame is shown three times, so that the camera appears to be at rest.
    const rests = places().flatMap((frame) => [frame, frame, frame]);
    shots = { rests, turn: turn(24), drive: drive(50, 1.6), fast: fastDrive(60, 1.4), pivot: pivot() };
    browser = await launch({ viewport: { width: 1200, height: 900 }, reducedMotion: "reduce" });
});
after(async () => {
    await browser?.close();
    if (folder) rmSync(folder, { recursive: true, force: true });
});

test("the page calibrates lens, mount, direction and readout time, and the run uses them", async () => {
    const file = join(folder, "camera.yaml");
    const run = await new Run().start(["--calibrate-to", file]);
    try {
        const { page, complaints } = await open(browser.context, `${run.url}calibration`);
        run.show(shots.rests);
        await page.waitForSelector("[data-step=lens]:enabled");
        assert.equal(await page.locator(".steps .known").count(), 0);

        // While the step collects frames, the page lists the requirements that have not been met yet.
        await page.click("[data-step=lens]");
        await page.waitForSelector("#calibration-needs li");
        assert.match(await page.textContent("#calibration-needs"), /\w+/);
        await page.waitForFunction(() => /[1-8] of 8 directions/.test(document.getElementById("calibration-turns-text").textContent));
        await page.click("#calibration-cancel");
        await page.waitForSelector("#calibration-current", { state: "hidden" });
        assert.ok(!existsSync(file));

        assert.match(await calibrate(page, run, "lens", shots.rests), /good/);
        let camera = cameraIn(file);
        const sigma = camera.k_per_px2 && Number(/k_per_px2: (\S+)\n/.exec(readFileSync(file, "utf8").split("sigma:")[1])[1]);
        assert.ok(Math.abs(camera.k_per_px2 - kLens_per_px2) < 4 * sigma, JSON.stringify({ camera, sigma }));
        for (const scale of camera.mm_per_px) assert.ok(Math.abs(scale / kScale_mm_per_px - 1) < 1e-3, String(scale));
        const field_px = Number(/right; ([\d.]+) px/.exec(await page.textContent("#calibration-field-text"))[1]);
        assert.ok(field_px < kCorner_px * 0.01, String(field_px));

        await calibrate(page, run, "spin", shots.turn);
        await picture(page, "web-calibration-mount");
        camera = cameraIn(file);
        const mount = mountOf(camera);
        assert.ok(Math.hypot(mount.x - kMount_mm.x, mount.y - kMount_mm.y) < 0.1, JSON.stringify(mount));
        const shown = /reference([-+][\d.]+), ([-+][\d.]+)/.exec(await page.textContent("#calibration-report"));
        assert.ok(Math.hypot(Number(shown[1]) - kMount_mm.x, Number(shown[2]) - kMount_mm.y) < 0.01, String(shown));

        // The run uses the calibrated mount, so the position shown does not change while the robot turns on the spot.
        const { page: live } = await open(browser.context, run.url);
        await live.waitForFunction(
            ([x_mm, y_mm]) => {
                const number = (id) => Number(document.getElementById(id).textContent.replace(/[^-.\d]/g, ""));
                const name = document.getElementById("live-x-name").textContent;
                return /pattern/.test(name) && Math.hypot(number("live-x") - x_mm, number("live-y") - y_mm) < 0.1;
            },
            [kPlace.x * kSpacing_mm, kPlace.y * kSpacing_mm],
        );
        await live.close();

        await calibrate(page, run, "drive", shots.drive);
        camera = cameraIn(file);
        assert.ok(Math.abs(camera.theta_offset_rad - kHeading_rad) < 0.002, JSON.stringify(camera));

        await calibrate(page, run, "readout", shots.fast);
        camera = cameraIn(file);
        assert.ok(Math.abs(camera.readout_ms - kReadout_ms) < 0.5, JSON.stringify(camera));
        assert.equal(await page.locator(".steps .known").count(), 4);

        // Calibrating the lens again does not change the mount.
        await calibrate(page, run, "lens", shots.rests);
        const again = cameraIn(file);
        assert.equal(again.theta_offset_rad, camera.theta_offset_rad);
        assert.equal(again.readout_ms, camera.readout_ms);
        const kept = mountOf(again);
        assert.ok(Math.hypot(kept.x - kMount_mm.x, kept.y - kMount_mm.y) < 0.1, JSON.stringify(kept));
        assert.deepEqual(complaints, []);
        await page.close();
        dotpose("locate", "--camera", file, join(folder, "places/frame_000000.pgm"));
    } finally {
        assert.equal(await run.stop(), 0, run.messages);
    }
});

test("the page keeps the mount of the file that it replaces", async () => {
    const file = join(folder, "former.yaml");
    const former = ["format: dotpose-camera", "version: 1", "width_px: 188", "height_px: 120", "k_per_px2: -8e-6", "centre_px: [93.5, 59.5]"];
    writeFileSync(file, [...former, "mm_per_px: [0.046, 0.046]", "reference_px: [140, 20]", "theta_offset_rad: 0.5", "sigma:", "  k_per_px2: 1e-7", ""].join("\n"));
    const run = await new Run().start(["--calibrate-to", file]);
    try {
        const { page } = await open(browser.context, `${run.url}calibration`);
        run.show(shots.rests);
        await page.waitForSelector(".steps .known");
        assert.match(await page.textContent("#calibration-steps"), /\+28\.648 degrees/);
        await page.click("[data-step=lens]");
        await page.waitForFunction(titleIs, ": result");
        await page.click("#calibration-save");
        await page.waitForFunction(titleIs, ": saved");
        const camera = cameraIn(file);
        assert.ok(camera.theta_offset_rad === 0.5, JSON.stringify(camera));
        assert.ok(Math.hypot(camera.reference_px[0] - 140, camera.reference_px[1] - 20) < 1.5, JSON.stringify(camera));
        assert.ok(Math.abs(camera.k_per_px2 / kLens_per_px2 - 1) < 0.02, JSON.stringify(camera));
        await page.close();
    } finally {
        await run.stop();
    }
});

/** Takes screenshots for docs/web.md if the environment variable DOTPOSE_PICTURES names a folder. */
async function picture(page, name) {
    if (process.env.DOTPOSE_PICTURES) await takeForms(page, process.env.DOTPOSE_PICTURES, name);
}

/** Returns the program's newest output line. */
function newestLine(page) {
    return page.evaluate(
        () =>
            new Promise((resolve) => {
                const socket = new WebSocket(`ws://${location.host}/live`);
                socket.onopen = () => socket.send(JSON.stringify({ do: "subscribe", topic: "state" }));
                socket.onmessage = ({ data }) => {
                    socket.close();
                    resolve(JSON.parse(data.slice(data.indexOf("\n"))).line);
                };
            }),
    );
}

test("the tip of a pen is calibrated by pivoting, and the run uses it", async () => {
    const file = join(folder, "pen.yaml");
    const known = ["width_px: 320", "height_px: 240", "k_per_px2: 0", "centre_px: [159.5, 119.5]", `focal_px: ${kPen.focal_px}`];
    const kept = { theta_offset_rad: 0.25, gain: 2 };
    writeFileSync(file, ["format: dotpose-camera", "version: 1", ...known, "theta_offset_rad: 0.25", "gain: 2", ""].join("\n"));
    const source = ["-", "--size", kPen.size, "--fps", String(1000 / kPeriod_ms)];
    const run = await new Run().start(["--calibrate-to", file, "--pose", "space", "--spacing", String(kPen.spacing_mm)], source);
    try {
        const { page, complaints } = await open(browser.context, `${run.url}calibration`);
        run.show(shots.pivot.slice(0, 1));
        await page.click("[data-step=pivot]");
        await page.waitForFunction(() => document.querySelectorAll("#calibration-needs li").length === 9);
        assert.match(await page.textContent("#calibration-needs"), /tilt the pen farther.*towards the right edge.*towards the upper right corner/);
        assert.match(await page.textContent("#calibration-now"), /the tip stays at its point/);
        // Fewer than six frames are not enough to determine the tip of the pen.
        await page.waitForFunction(() => /^1 frame /.test(document.getElementById("calibration-frames").textContent));
        run.show(shots.pivot.slice(0, 2));
        await page.waitForTimeout(6 * kPeriod_ms);
        run.show(shots.pivot.slice(0, 4));
        await page.waitForFunction(() => Number.parseInt(document.getElementById("calibration-frames").textContent, 10) >= 3);
        await page.click("#calibration-finish");
        await page.waitForFunction(() => document.getElementById("calibration-problem").textContent.includes("at least 6 are needed"));

        await page.click("[data-step=pivot]");
        await page.waitForFunction(titleIs, ": taking frames");
        run.show(shots.pivot.slice(0, 20));
        await page.waitForFunction(() => /[1-8] of 8/.test(document.getElementById("calibration-turns-text").textContent));
        assert.match(await page.textContent("#calibration-tilts-text"), /up to \d+°/);
        await requireAccessible(page);
        await picture(page, "web-calibration-pen");
        await page.click("#calibration-cancel");
        const report = await calibrate(page, run, "pivot", shots.pivot);
        assert.match(report, /tip.*±.*residual/s);
        const camera = cameraIn(file);
        kPen.tip_mm.forEach((mm, i) => assert.ok(Math.abs(camera.tip_mm[i] - mm) < 0.02, JSON.stringify(camera)));
        assert.ok(Math.abs(camera.tip_rest_mm - kPen.rest_mm) < 0.02, JSON.stringify(camera));
        for (const [key, value] of Object.entries(kept)) assert.equal(camera[key], value, key);
        assert.ok(Math.abs(camera.focal_px - kPen.focal_px) < 1e-6);
        assert.match(await page.textContent("#calibration-steps"), /0\.50\d ± .* mm from the camera/);

        // The output lines for the next frames contain the tip position.
        run.show(shots.pivot.slice(5, 6));
        await page.waitForFunction(() => document.getElementById("live-status").textContent === "live");
        let line;
        do line = await newestLine(page);
        while (line.tip_x_mm === undefined);
        kPen.at_mm.forEach((mm, i) => assert.ok(Math.abs(line[["tip_x_mm", "tip_y_mm"][i]] - mm) < 0.05, JSON.stringify(line)));
        assert.equal(line.pen_down, true);
        assert.deepEqual(complaints, []);
        await page.close();
    } finally {
        assert.equal(await run.stop(), 0, run.messages);
    }
});

test("the page says why there is no result", async () => {
    mkdirSync(join(folder, "gone"));
    const run = await new Run().start(["--calibrate-to", join(folder, "gone/camera.yaml")]);
    const problemIs = (text) => document.getElementById("calibration-problem").textContent.toLowerCase().includes(text);
    try {
        const { page, complaints } = await open(browser.context, `${run.url}calibration`);
        run.show(shots.rests);
        await page.click("[data-step=readout]");
        await page.waitForFunction(problemIs, "first calibrate the lens");
        await page.click("[data-step=pivot]");
        await page.waitForFunction(problemIs, "no focal length: first calibrate the lens, and tilt the pen");

        run.show(shots.turn.slice(0, 2));
        await page.click("[data-step=spin]");
        await page.waitForFunction(() => /^2 /.test(document.getElementById("calibration-frames").textContent));
        await page.click("#calibration-finish");
        await page.waitForFunction(problemIs, "at least 3 are needed");

        // Frames from two positions are not enough to calibrate the lens.
        run.show(shots.rests.slice(0, 6));
        await page.click("[data-step=lens]");
        await page.click("#calibration-finish");
        await page.waitForFunction(problemIs, "missing:");
        run.show(shots.rests);
        await page.click("[data-step=lens]");
        await page.waitForFunction(titleIs, ": result");
        rmSync(join(folder, "gone"), { recursive: true });
        await page.click("#calibration-save");
        await page.waitForFunction(problemIs, "cannot create");
        assert.match(await page.textContent("#calibration-title"), /: result$/);
        // The result is not lost. It can be saved after the folder has been created again.
        mkdirSync(join(folder, "gone"));
        await page.click("#calibration-save");
        await page.waitForFunction(titleIs, ": saved");
        assert.deepEqual(complaints, []);
        await page.close();
    } finally {
        await run.stop();
    }
});

test("without --calibrate-to, the page says how to calibrate", async () => {
    const run = await new Run().start([]);
    try {
        const { page } = await open(browser.context, `${run.url}calibration`);
        run.show(shots.rests);
        await page.waitForSelector("#calibration-off:not([hidden])");
        assert.match(await page.textContent("#calibration-off"), /--calibrate-to/);
        assert.equal(await page.locator("[data-step]:enabled").count(), 0);
        await page.close();
    } finally {
        await run.stop();
    }
});

test("axe finds no violation in any state, and nothing is wider than the screen", async () => {
    const run = await new Run().start(["--calibrate-to", join(folder, "axe.yaml")]);
    try {
        run.show(shots.rests);
        const { page } = await open(browser.context, `${run.url}calibration`);
        await page.waitForSelector("[data-step=lens]:enabled");
        await requireAccessible(page);
        assert.equal(await page.textContent("#live-source"), "standard input");
        run.show(shots.rests.slice(0, 18));
        await page.click("[data-step=lens]");
        await page.waitForFunction(() => /^[4-6] frames/.test(document.getElementById("calibration-frames").textContent));
        await requireAccessible(page);
        await picture(page, "web-calibration-lens");
        run.show(shots.rests);
        await page.waitForFunction(titleIs, ": result");
        await requireAccessible(page);
        await picture(page, "web-calibration-result");
        await page.click("#calibration-save");
        await page.waitForFunction(titleIs, ": saved");
        run.show(shots.turn.slice(0, 2));
        await page.click("[data-step=spin]");
        await page.waitForFunction(() => /^2 /.test(document.getElementById("calibration-frames").textContent));
        await requireAccessible(page);
        await page.click("#calibration-finish");
        await page.waitForFunction(titleIs, ": no result");
        await requireAccessible(page);
        await page.click("[data-step=spin]");
        await page.waitForFunction(titleIs, ": taking frames");
        run.show(shots.turn);
        await page.waitForFunction(titleIs, ": result");
        await requireAccessible(page);
        await page.close();
    } finally {
        await run.stop();
    }
});

test("a drive on video is calibrated", async () => {
    const sheets = join(folder, "sheets.json");
    const video = join(folder, "drive.mp4");
    const file = join(folder, "video.yaml");
    dotpose("print", "-o", join(folder, "table.pdf"), "--sheets", sheets, "--name", "table");
    const scene = ["--size", "320x240", "--mm-per-px", "0.03", "--k", "-2e-6", "--seed", "11"];
    dotpose("simulate", "--drive", "--sheets", sheets, "--frames", "800", "-o", video, ...scene);
    const run = await new Run().start(["--sheets", sheets, "--calibrate-to", file], [video, "--realtime", "--fps", "20"]);
    try {
        const { page } = await open(browser.context, `${run.url}calibration`);
        await page.click("[data-step=lens]");
        await page.waitForFunction(titleIs, ": result");
        assert.match(await page.textContent("#calibration-report"), /of the sheet in the sheet file/);
        await page.click("#calibration-save");
        await page.waitForFunction(titleIs, ": saved");
        const camera = cameraIn(file);
        assert.ok(Math.abs(camera.k_per_px2 / -2e-6 - 1) < 0.01, JSON.stringify(camera));
        for (const scale of camera.mm_per_px) assert.ok(Math.abs(scale / 0.03 - 1) < 1e-3, String(scale));
        await page.close();
    } finally {
        await run.stop();
    }
});
