// Tests the panel that shows the pose of the camera in space on the page of `dotpose watch --web`. Simulates frames
// from a tilted camera, and compares the angles on the page with the true angles.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { requireAccessible } from "./accessible.mjs";
import { dotpose, launch, open } from "./browser.mjs";
import { watchSource } from "./watch.mjs";

const kDistance_mm = 25;
const kTilt_deg = 20;
const kTurn_deg = 40;
const kYaw_deg = 30;

let folder;
let browser;

before(async () => {
    folder = mkdtempSync(join(tmpdir(), "dotpose-space-"));
    const view = ["--size", "320x240", "--working-distance", String(kDistance_mm), `--tilt=0,${kTilt_deg}`, "--angle", String(kTurn_deg)];
    dotpose("simulate", "-o", join(folder, "frames"), "--frames", "60", ...view);
    // The frames in "still" are from a camera at rest. Its height, tilt and turn are the same as in "frames", but the
    // pose of the sheet in the world is known.
    const sheets = join(folder, "sheets.json");
    dotpose("print", "-o", join(folder, "page.svg"), "--paper", "A5", "--origin", "1000,2000", "--sheets", sheets, "--name", "desk");
    dotpose("sheets", "place", "desk", "--sheets", sheets, "--x", "100", "--y", "50", "--yaw", String(kYaw_deg));
    const still = ["--section", "0,0", "--at", "1100.3,2150.6", "--preset", "nominal"];
    dotpose("simulate", "-o", join(folder, "still"), "--frames", "60", ...view, ...still);
    writeFileSync(
        join(folder, "camera.yaml"),
        "format: dotpose-camera\nversion: 1\nwidth_px: 320\nheight_px: 240\nk_per_px2: 0\n" +
            `centre_px: [159.5, 119.5]\nfocal_px: ${kDistance_mm / 0.046}\n`,
    );
    browser = await launch({ viewport: { width: 1200, height: 1100 }, reducedMotion: "reduce" });
});
after(async () => {
    await browser?.close();
    if (folder) rmSync(folder, { recursive: true, force: true });
});

/** Runs `dotpose watch` on `frames`, waits until its page shows the first frame, and returns the result of `look`. */
async function seen(frames, options, look) {
    const run = await watchSource([join(folder, frames), "--realtime", "--fps", "3"], options);
    try {
        const { page, complaints } = await open(browser.context, run.url);
        await page.waitForFunction(() => document.getElementById("live-counts").textContent.startsWith("frame"));
        const found = await look(page);
        assert.deepEqual(complaints, []);
        await page.close();
        return found;
    } finally {
        await run.stop();
    }
}

/** Returns the values in the panel, their standard deviations, and the angles in the drawing. */
function shownIn(page) {
    return page.evaluate(() => {
        const text = (id) => document.getElementById(`live-${id}`).textContent;
        const number = (id) => Number.parseFloat(text(id).replace("± ", "")) * (text(id).endsWith("µm") ? 1e-3 : 1);
        const rotation = (id) => Number(/rotate\((\S+)/.exec(document.getElementById(`live-space-${id}`).getAttribute("transform"))[1]);
        return {
            source: text("space-source"),
            name: text("space-name"),
            ...{ height_mm: number("height"), tilt_deg: number("tilt"), azimuth_deg: number("azimuth"), turn_deg: number("turn") },
            ...{ side_deg: rotation("side"), lean_deg: rotation("lean") },
            sigmas: ["height", "tilt", "azimuth", "turn"].map((id) => number(`${id}-sigma`)),
        };
    });
}

const kHeight_mm = kDistance_mm * Math.cos((kTilt_deg * Math.PI) / 180);
const near = (shown, name, expected, tolerance) =>
    assert.ok(Math.abs(shown[name] - expected) < tolerance, `${name} is not ${expected}: ${JSON.stringify(shown)}`);
const space = () => ["--camera", join(folder, "camera.yaml"), "--pose", "space"];

test("the page shows height, tilt, azimuth and turn, and draws the camera", async () => {
    const shown = await seen("frames", [...space(), "--code", "anoto"], async (page) => {
        await page.waitForFunction(() => !document.getElementById("live-space").hidden);
        if (process.env.DOTPOSE_PICTURES) await page.screenshot({ path: join(process.env.DOTPOSE_PICTURES, "space.png") });
        await requireAccessible(page);
        return shownIn(page);
    });
    // The distance from the camera to the paper decreases along the image x axis, so the camera leans in that
    // direction.
    near(shown, "height_mm", kHeight_mm, 0.05);
    near(shown, "tilt_deg", kTilt_deg, 0.1);
    near(shown, "azimuth_deg", kTurn_deg, 0.3);
    near(shown, "turn_deg", kTurn_deg, 0.3);
    near(shown, "side_deg", kTilt_deg, 0.1);
    near(shown, "lean_deg", kTurn_deg, 0.3);
    assert.equal(shown.name, "The camera over the sheet");
    for (const sigma of shown.sigmas) assert.ok(sigma > 0 && sigma < 0.2, JSON.stringify(shown));
});

test("on a sheet in the world, the tracked pose is shown in the world", async () => {
    const shown = await seen("still", [...space(), "--sheets", join(folder, "sheets.json")], async (page) => {
        await page.waitForFunction(() => document.getElementById("live-space-source").textContent === "tracked");
        await page.waitForFunction(() => Number.parseInt(document.getElementById("live-counts").textContent.slice(6)) > 8);
        await requireAccessible(page);
        return shownIn(page);
    });
    near(shown, "height_mm", kHeight_mm, 0.05);
    near(shown, "tilt_deg", kTilt_deg, 0.1);
    // Angles in the world are counterclockwise. The sheet is turned by its yaw.
    near(shown, "azimuth_deg", kYaw_deg - kTurn_deg, 0.3);
    near(shown, "turn_deg", kYaw_deg - kTurn_deg, 0.3);
    // Angles on the screen are clockwise.
    near(shown, "lean_deg", kTurn_deg - kYaw_deg, 0.3);
    near(shown, "side_deg", kTilt_deg, 0.1);
    assert.equal(shown.name, "The camera in the world, y up");
    for (const sigma of shown.sigmas) assert.ok(sigma > 0 && sigma < 0.1, JSON.stringify(shown));
});

test("without --pose space, the page has no pose in space", async () => {
    const isHidden = await seen("frames", [], (page) => page.evaluate(() => document.getElementById("live-space").hidden));
    assert.equal(isHidden, true);
});
