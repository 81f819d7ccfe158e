// Tests the pose of the camera in space on the page of `dotpose watch --web`: simulated frames of a tilted camera,
// whose known angles are read from the page.
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

let folder;
let browser;

before(async () => {
    folder = mkdtempSync(join(tmpdir(), "dotpose-space-"));
    const view = ["--working-distance", String(kDistance_mm), `--tilt=0,${kTilt_deg}`, "--angle", String(kTurn_deg)];
    dotpose("simulate", "-o", join(folder, "frames"), "--frames", "60", "--size", "320x240", ...view);
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

/** Opens the page of a run, waits for its first frame, and returns what `look` finds there. */
async function seen(options, look) {
    const run = await watchSource([join(folder, "frames"), "--realtime", "--fps", "3", "--code", "anoto"], options);
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

test("the page shows height, tilt, azimuth and turn, and draws the camera", async () => {
    const options = ["--camera", join(folder, "camera.yaml"), "--pose", "space"];
    const shown = await seen(options, async (page) => {
        await page.waitForFunction(() => !document.getElementById("live-space").hidden);
        if (process.env.DOTPOSE_PICTURES) await page.screenshot({ path: join(process.env.DOTPOSE_PICTURES, "space.png") });
        await requireAccessible(page);
        return page.evaluate(() => {
            const number = (id) => Number(document.getElementById(id).textContent.replace(/[^-.\d]/g, ""));
            const rotation = (id) => Number(/rotate\((\S+)/.exec(document.getElementById(id).getAttribute("transform"))[1]);
            return {
                ...{ height_mm: number("live-height"), tilt_deg: number("live-tilt") },
                ...{ azimuth_deg: number("live-azimuth"), turn_deg: number("live-turn") },
                ...{ side_deg: rotation("live-space-side"), lean_deg: rotation("live-space-lean") },
            };
        });
    });
    // The paper comes closer along the image x axis, so the camera leans in this direction.
    const near = (value, expected, tolerance) => assert.ok(Math.abs(value - expected) < tolerance, JSON.stringify(shown));
    near(shown.height_mm, kDistance_mm * Math.cos((kTilt_deg * Math.PI) / 180), 0.05);
    near(shown.tilt_deg, kTilt_deg, 0.1);
    near(shown.azimuth_deg, kTurn_deg, 0.3);
    near(shown.turn_deg, kTurn_deg, 0.3);
    near(shown.side_deg, kTilt_deg, 0.1);
    near(shown.lean_deg, kTurn_deg, 0.3);
});

test("without --pose space, the page has no pose in space", async () => {
    const isHidden = await seen([], (page) => page.evaluate(() => document.getElementById("live-space").hidden));
    assert.equal(isHidden, true);
});
