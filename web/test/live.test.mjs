// Tests the page of `dotpose watch --web` on a video of a simulated drive. Compares the poses shown on the page with
// the true poses.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { requireAccessible } from "./accessible.mjs";
import { dotpose, launch, open } from "./browser.mjs";
import { readCsv } from "./clip.mjs";
import { watchSource } from "./watch.mjs";


let folder;
let browser;
let drive;

/** Simulates a drive over a sheet at 100 mm/s and 50 frames/s. Returns the video and the true poses. */
function makeDrive(name, frames, ...options) {
    const sheets = join(folder, "sheets.json");
    const video = join(folder, name);
    const scene = ["--size", "320x240", "--mm-per-px", "0.03", "--seed", "11", ...options];
    dotpose("simulate", "--drive", "--sheets", sheets, "--frames", String(frames), "-o", video, ...scene);
    return { video, truth: readCsv(readFileSync(video.replace(".mp4", "-truth.csv"), "utf8")) };
}

/** Starts `dotpose watch` with a web page. Plays the video at a fifth of its original speed. */
function watch({ video }, options = [], address = "0") {
    return watchSource([video, "--realtime", "--fps", "10", "--web-recordings", folder], options, address);
}

/** Returns the frame number, the pose and the state that the page currently shows. */
function shownPose(page) {
    return page.evaluate(() => {
        const text = (id) => document.getElementById(id).textContent;
        const number = (id) => Number(text(id).replace(/[^-.\d]/g, ""));
        return {
            frame: Number(/frame (\d+)/.exec(text("live-counts"))?.[1] ?? NaN),
            ...{ x_mm: number("live-x"), y_mm: number("live-y"), theta_deg: number("live-angle") },
            ...{ state: text("live-state"), x_name: text("live-x-name"), speed: number("live-speed") },
        };
    });
}

const isLive = () => document.getElementById("live-counts").textContent.startsWith("frame");

before(async () => {
    folder = mkdtempSync(join(tmpdir(), "dotpose-live-"));
    dotpose("print", "-o", join(folder, "table.pdf"), "--sheets", join(folder, "sheets.json"), "--name", "<b>table</b>");
    drive = makeDrive("drive.mp4", 500);
    browser = await launch({ viewport: { width: 1200, height: 900 }, reducedMotion: "reduce" });
});
after(async () => {
    await browser?.close();
    if (folder) rmSync(folder, { recursive: true, force: true });
});

test("the page shows the poses of a drive", async () => {
    const run = await watch(drive);
    try {
        const { page, complaints } = await open(browser.context, run.url);
        await page.waitForFunction(isLive);
        const seen = new Set();
        while (seen.size < 20) {
            const shown = await shownPose(page);
            if (seen.has(shown.frame)) continue;
            seen.add(shown.frame);
            const at = drive.truth[shown.frame];
            assert.equal(shown.state, "moving");
            assert.match(shown.x_name, /pattern/);
            assert.ok(Math.hypot(shown.x_mm - at.x_mm, shown.y_mm - at.y_mm) < 0.02, JSON.stringify({ shown, at }));
            const turn_deg = ((shown.theta_deg - at.theta_deg + 540) % 360) - 180;
            assert.ok(Math.abs(turn_deg) < 0.3, JSON.stringify({ shown, at }));
            if (shown.frame > 25) assert.ok(Math.abs(shown.speed - 20) < 1, JSON.stringify(shown));
        }
        assert.deepEqual(complaints, []);
        await page.close();
    } finally {
        await run.stop();
    }
});

test("the page shows the frame, the map, refusals and recordings", async () => {
    const run = await watch(drive, ["--sheets", join(folder, "sheets.json"), "--log", join(folder, "log.csv")]);
    try {
        const { page, complaints } = await open(browser.context, run.url);
        await page.waitForFunction(isLive);
        // The frame has been drawn if the canvas contains grey paper with the colours of the axes on top.
        await page.waitForFunction(() => {
            const canvas = document.getElementById("live-frame");
            const context = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
            context.drawImage(canvas, 0, 0);
            const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
            let grey = 0;
            let red = 0;
            for (let i = 0; i < data.length; i += 4) {
                grey += data[i + 3] === 255 && data[i] > 100 && data[i] === data[i + 1] && data[i] === data[i + 2];
                red += data[i] > 200 && data[i + 1] < 120 && data[i + 2] < 90;
            }
            return grey > data.length / 16 && red > 50;
        });
        // Names from files are shown as plain text.
        await page.waitForFunction(() => document.getElementById("live-map-name").textContent === "The path over <b>table</b>");
        assert.match((await shownPose(page)).x_name, /<b>table<\/b>/);
        assert.match(await page.textContent("#live-refused"), /none/);
        assert.equal(await page.textContent("#live-advice"), "The newest frame was located.");
        // For a good frame, the page does not advise changing the light or the focus.
        assert.equal(await page.textContent("#live-picture-advice"), "The picture is bright and sharp enough.");
        assert.ok(Number.parseInt(await page.textContent("#live-contrast-text"), 10) > 60);

        await page.click("#live-record");
        await page.waitForFunction(() => /: \d\d+ frames/.test(document.getElementById("live-recorded").textContent));
        await page.click("#live-record");
        const link = page.locator("#live-files a[href$='.csv']").last();
        await page.waitForFunction(() => document.querySelectorAll("#live-files a").length === 3);
        const [file] = await Promise.all([page.waitForEvent("download"), link.click()]);
        const lines = readCsv(readFileSync(await file.path(), "utf8"));
        assert.ok(lines.length >= 10 && lines.every((line) => line.status === "ok" && line.sheet === "<b>table</b>"));
        assert.deepEqual(complaints, []);
        await page.close();
    } finally {
        await run.stop();
    }
});

test("frames without a sheet do not count as sharp", async () => {
    dotpose("simulate", "-o", join(folder, "still"), "--frames", "1", "--size", "320x240", "--mm-per-px", "0.03", "--seed", "3");
    const still = readFileSync(join(folder, "still", "frame_000000.pgm")).subarray(-320 * 240);
    // The frame shows a dark table with a faint texture.
    const table = Buffer.from(still.map((_, i) => (i % 16 < 8 ? 36 : 40)));
    const run = await watchSource(["-", "--size", "320x240", "--fps", "10"], ["--code", "anoto"]);
    let shown = table;
    const camera = setInterval(() => run.input.write(shown), 100);
    try {
        const { page } = await open(browser.context, run.url);
        await page.waitForFunction(() => document.getElementById("live-contrast-text").textContent === "4 grey levels");
        shown = still;
        await page.waitForFunction(() => document.getElementById("live-advice").textContent === "The newest frame was located.");
        await page.waitForFunction(() => Number.parseInt(document.getElementById("live-sharpness-text").textContent, 10) >= 95);
        shown = table;
        await page.waitForFunction(() => Number.parseInt(document.getElementById("live-sharpness-text").textContent, 10) < 20);
        // A picture of smooth paper in uneven light must not be reported as out of focus.
        shown = Buffer.from(still.map((_, i) => 100 + ((i % 320) * 100) / 320));
        await page.waitForFunction(() => document.getElementById("live-picture-advice").textContent.startsWith("No dots are found"));
        await page.close();
    } finally {
        clearInterval(camera);
        await run.stop();
    }
});

test("the page says why frames are refused, and what to change", async () => {
    const run = await watch(makeDrive("dark.mp4", 200, "--paper-level", "12"));
    try {
        const { page } = await open(browser.context, run.url);
        await page.waitForFunction(() => document.getElementById("live-advice").textContent.includes("use more light"));
        assert.match(await page.textContent("#live-picture-advice"), /^Brighter/);
        await page.waitForFunction(() => /of \d+ frames/.test(document.getElementById("live-refused").textContent));
        await page.waitForSelector("#live-reasons li");
        assert.equal((await shownPose(page)).state, "lost");
        await page.close();
    } finally {
        await run.stop();
    }
});

test("the page says that the program ended", async () => {
    const run = await watch(drive);
    const page = await browser.context.newPage();
    await page.goto(run.url);
    await page.waitForFunction(() => document.getElementById("live-status").textContent === "live");
    await run.stop();
    await page.waitForFunction(() => document.getElementById("live-status").textContent.startsWith("no connection"));
    await page.close();
});

test("a token opens the page on a network", async () => {
    const run = await watch(drive, [], "0.0.0.0:0");
    try {
        const address = new URL(run.url);
        const { page, complaints } = await open(browser.context, `http://127.0.0.1:${address.port}/${address.search}`);
        await page.waitForFunction(isLive);
        assert.equal(await page.evaluate(() => location.search), "");
        assert.deepEqual(complaints, []);
        await page.close();
        const other = await browser.context.newPage();
        await other.context().clearCookies();
        assert.equal((await other.goto(`http://127.0.0.1:${address.port}/`)).status(), 401);
        await other.close();
    } finally {
        await run.stop();
    }
});

test("axe finds no violation, and nothing is wider than the screen", async () => {
    const run = await watch(drive, ["--sheets", join(folder, "sheets.json")]);
    try {
        const { page } = await open(browser.context, run.url);
        await page.waitForFunction(isLive);
        await requireAccessible(page);
        await page.click("#live-record");
        await page.waitForFunction(() => /: \d+ frames/.test(document.getElementById("live-recorded").textContent));
        await requireAccessible(page);
        await page.click("#live-record");
        await page.waitForFunction(() => document.querySelectorAll("#live-files a").length >= 2);
        await requireAccessible(page);
        await page.close();
    } finally {
        await run.stop();
    }
    const dark = await watch(makeDrive("darker.mp4", 200, "--paper-level", "12"));
    try {
        const { page } = await open(browser.context, dark.url);
        await page.waitForFunction(() => document.getElementById("live-advice").textContent.includes("use more light"));
        await page.waitForSelector("#live-reasons li");
        await requireAccessible(page);
        await page.close();
    } finally {
        await dark.stop();
    }
});
