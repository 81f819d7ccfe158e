// Tests the panel of the "Look" view that shows the pose of the camera in space. Simulates frames from a tilted camera,
// and compares the poses on the page with the true poses and with the output of the command-line tool.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { requireAccessible } from "./accessible.mjs";
import { dotpose, launch, open, serve } from "./browser.mjs";
import { makeClip, readCsv } from "./clip.mjs";

const kDistance_mm = 30;
const kTilt_deg = 20;
const kTurn_deg = 40;
const kFocal_px = kDistance_mm / 0.046;
const kHeight_mm = kDistance_mm * Math.cos((kTilt_deg * Math.PI) / 180);
const kView = ["--working-distance", String(kDistance_mm), `--tilt=0,${kTilt_deg}`, "--angle", String(kTurn_deg)];
const kCamera =
    "format: dotpose-camera\nversion: 1\nwidth_px: 640\nheight_px: 480\nk_per_px2: 0  # no distortion\n" +
    `centre_px: [319.5, 239.5]\nfocal_px: ${kFocal_px}\nsigma:\n  focal_px: 0.3\n`;

let folder;
let server;
let browser;
let clip;
/** Output lines of the tool for the frames of the clip, with the pose in space. */
let lines;

before(async () => {
    folder = mkdtempSync(join(tmpdir(), "dotpose-look-"));
    writeFileSync(join(folder, "camera.yaml"), kCamera);
    clip = makeClip(folder, { frames: 40, size: "640x480", options: kView });
    const space = ["--camera", join(folder, "camera.yaml"), "--pose", "space"];
    const frames = clip.map(({ file }) => join(folder, "frames", file));
    lines = dotpose("locate", ...space, ...frames).trim().split("\n").map((line) => JSON.parse(line));
    server = await serve();
    browser = await launch({ clip: join(folder, "clip.y4m"), viewport: { width: 1200, height: 1100 }, reducedMotion: "reduce" });
});
after(async () => {
    await browser?.close();
    await server?.close();
    if (folder) rmSync(folder, { recursive: true, force: true });
});

const look = () => open(browser.context, `${server.url}#look`);
const file = (name, text) => ({ name, mimeType: "application/yaml", buffer: Buffer.from(text) });
const openCamera = (page, text = kCamera) => page.setInputFiles("#look-camera-file", file("camera.yaml", text));
const openPicture = (page, buffer) => page.setInputFiles("#look-file", { name: "view.png", mimeType: "image/png", buffer });
const near = (value, expected, tolerance, name) =>
    assert.ok(Math.abs(value - expected) <= tolerance, `${name}: ${value}, not ${expected}`);

/** Returns the values shown on the page and their standard deviations, as pairs [value, sigma]. */
async function shown(page) {
    await page.waitForFunction(() => document.getElementById("look-height").textContent !== "–");
    const one = async (id) => {
        const text = (await page.textContent(`#look-${id}`)).replace("± ", "");
        return Number.parseFloat(text) * (text.endsWith("µm") ? 1e-3 : 1);
    };
    const number = async (name) => [await one(name), await one(`${name}-sigma`)];
    return { height: await number("height"), tilt: await number("tilt"), azimuth: await number("azimuth"), turn: await number("turn") };
}

/** Opens the camera file and frame `i` of the clip. Returns the values shown. */
async function openView(page, i) {
    await openCamera(page);
    await page.waitForFunction(() => document.getElementById("look-camera-state").textContent.startsWith("camera.yaml"));
    await openPicture(page, clip[i].png);
    return shown(page);
}

test("a picture has the pose in space of the tool", async () => {
    const { page, complaints } = await look();
    const { height, tilt, azimuth, turn } = await openView(page, 3);
    assert.equal(await page.textContent("#look-camera-state"), "camera.yaml, for 640 x 480 px");
    near(height[0], -lines[3].camera_z_mm, 0.0006, "height");
    near(tilt[0], lines[3].camera_tilt_deg, 0.006, "tilt");
    near(azimuth[0], lines[3].camera_azimuth_deg, 0.06, "azimuth");
    near(turn[0], lines[3].camera_turn_deg, 0.006, "turn");
    near(height[0], kHeight_mm, 0.05, "true height");
    near(tilt[0], kTilt_deg, 0.1, "true tilt");
    await requireAccessible(page);
    assert.deepEqual(complaints, []);
    await page.close();
});

test("standard deviations are those of repeated measurements", async () => {
    const { page } = await look();
    const pose = await openView(page, 0);
    const keys = { height: "camera_z_mm", tilt: "camera_tilt_deg", azimuth: "camera_azimuth_deg", turn: "camera_turn_deg" };
    for (const [name, key] of Object.entries(keys)) {
        const mean = lines.reduce((sum, line) => sum + line[key], 0) / lines.length;
        const squares = lines.reduce((sum, line) => sum + (line[key] - mean) ** 2, 0);
        const scatter = Math.sqrt(squares / (lines.length - 1));
        near(pose[name][1], scatter, 0.35 * scatter, `deviation of ${name}`);
    }
    await page.close();
});

test("the camera has poses in space, and the log contains them", async () => {
    const { page, complaints } = await look();
    await openCamera(page);
    await page.click("#look-start");
    await page.waitForFunction(() => parseInt(document.getElementById("look-logged").textContent) >= 10);
    const [saved] = await Promise.all([page.waitForEvent("download"), page.click("#look-log")]);
    const log = await saved.path();
    const logged = readCsv(readFileSync(log, "utf8"));
    assert.ok(logged.length >= 10);
    for (const line of logged) {
        near(-line.camera_z_mm, kHeight_mm, 0.05, "height");
        near(line.camera_tilt_deg, kTilt_deg, 0.1, "tilt");
        near(line.camera_azimuth_deg, kTurn_deg, 0.3, "azimuth");
        near(line.camera_turn_deg, kTurn_deg, 0.3, "turn");
        assert.equal(line.camera_is_ambiguous, "false");
    }
    assert.equal(JSON.parse(dotpose("replay", log, "--format", "json")).fixes, logged.length);
    assert.deepEqual(complaints, []);
    await page.close();
});

test("a focal length alone is sufficient, and without it there is no pose in space", async () => {
    const { page } = await look();
    await openPicture(page, clip[5].png);
    await page.waitForFunction(() => document.getElementById("look-x").textContent !== "–");
    assert.equal(await page.isHidden("#look-space"), true);
    await page.fill("#look-focal", String(kFocal_px));
    await page.press("#look-focal", "Enter");
    near((await shown(page)).height[0], kHeight_mm, 0.05, "height");
    // With twice the focal length, the camera appears to be at twice the distance.
    await page.fill("#look-focal", String(2 * kFocal_px));
    await page.press("#look-focal", "Enter");
    await page.waitForFunction((mm) => parseFloat(document.getElementById("look-height").textContent) > 1.5 * mm, kHeight_mm);
    await page.fill("#look-focal", "");
    await page.press("#look-focal", "Enter");
    await page.waitForFunction(() => document.getElementById("look-space").hidden);
    await page.fill("#look-focal", "0");
    await page.press("#look-focal", "Enter");
    assert.match(await page.textContent("#look-hint"), /focal length must be from 1/);
    await page.close();
});

test("a camera file that cannot be used is refused with its reason", async () => {
    const { page } = await look();
    const refused = [
        ["hello", 'its "format" is not "dotpose-camera"'],
        ["", 'its "format" is not "dotpose-camera"'],
        [kCamera.replace("version: 1", "version: 2"), "its version is 2; this page reads version 1"],
        [kCamera.replace(/\nfocal_px.*/, ""), "it has no focal_px: calibrate with frames in which the camera is tilted by 10 to 30 degrees"],
        [kCamera.replace(/\nfocal_px.*/, "\nfocal_px: far"), "its focal_px is 'far'; it must be a number"],
        [kCamera.replace("319.5, ", ""), "its centre_px is '[239.5]'; it must be 2 numbers"],
        [kCamera.replace("k_per_px2: 0", "k_per_px2: 1"), "its k_per_px2 folds an image of 640 x 480 px"],
        [kCamera.replace("319.5", "-1000"), "its centre is more than 1000 px off the image centre"],
        [kCamera.replace(/\nfocal_px.*/, "\nfocal_px: 0"), "its focal length must be from 1 to 1,000,000 px"],
        [`${kCamera}flip: true\n`, "its frames are mirrored, which this page does not correct"],
        ["image_width: 640\ncamera_matrix:\n  rows: 3\n", "it is a file of ROS: make a camera file with dotpose calibrate, or enter the focal length"],
    ];
    for (const [text, reason] of refused) {
        await openCamera(page, text);
        const message = `'camera.yaml' is not read as a camera file: ${reason}.`;
        await page.waitForFunction((wanted) => document.getElementById("look-hint").textContent === wanted, message);
    }
    await openCamera(page, kCamera.replace("640", "320"));
    await openPicture(page, clip[1].png);
    const wrong = "No pose in space: 'camera.yaml' is for images of 320 x 480 px, and this one has 640 x 480 px.";
    await page.waitForFunction((wanted) => document.getElementById("look-hint").textContent === wanted, wrong);
    assert.notEqual(await page.textContent("#look-x"), "–");
    await page.close();
});

test("a mirrored tilt that is possible is reported", async () => {
    const { page } = await look();
    const still = mkdtempSync(join(folder, "far-"));
    const far = ["--working-distance", String(20_000 * 0.046), "--tilt=8,0"];
    const [{ png }] = makeClip(still, { frames: 1, size: "188x120", options: far });
    await page.fill("#look-focal", "20000");
    await page.press("#look-focal", "Enter");
    await openPicture(page, png);
    await page.waitForFunction(() => document.getElementById("look-space-source").textContent === "another tilt is possible");
    assert.match(await page.textContent("#look-hint"), /^Located, but two tilts explain these dots/);
    await page.close();
});
