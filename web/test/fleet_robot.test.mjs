// Tests what the page of `dotpose fleet --web` shows about a single robot: its stored history, trail and camera.
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { audit, requireAccessible } from "./accessible.mjs";
import { dotpose, open } from "./browser.mjs";
import { browser, fleet, folder, Robot, rowOf, until, untilInView, untilState } from "./fleet_robots.mjs";

function pixelsOf(page, colour) {
    return page.evaluate((name) => {
        const canvas = document.getElementById("fleet-map");
        const wanted = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
        const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
        copy.drawImage(canvas, 0, 0);
        const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
        let count = 0;
        for (let i = 0; i < data.length; i += 4)
            count += wanted === `#${[...data.subarray(i, i + 3)].map((byte) => byte.toString(16).padStart(2, "0")).join("")}`;
        return count;
    }, colour);
}

/** Returns the fraction of the graph's columns in which no state is drawn. */
function emptyShare(page) {
    return page.evaluate(() => {
        const { width, height } = document.getElementById("fleet-stored-graph");
        const copy = new OffscreenCanvas(width, height).getContext("2d");
        copy.drawImage(document.getElementById("fleet-stored-graph"), 0, 0);
        const { data } = copy.getImageData(0, height - 3, width, 1);
        return data.filter((value, i) => i % 4 === 3 && value === 0).length / width;
    });
}

test("the stored history of a robot is drawn on the map and over time", async () => {
    const database = join(folder, "fleet.db");
    const anna = new Robot("anna");
    const { url, stop } = await fleet(["--store", database]);
    const { page, complaints } = await open(browser.context, url);
    const text = () => page.textContent("#fleet-stored-text");
    const showSpan = async (span) => {
        await page.selectOption("#fleet-stored-span", span);
        await page.click("#fleet-stored-form button[type=submit]");
        await page.waitForFunction(() => !["", "reading the database"].includes(document.getElementById("fleet-stored-text").textContent));
    };
    await untilState(page, "anna", "moving");
    await page.waitForFunction(() => / [1-9]\d* stored/.test(document.getElementById("fleet-counts").textContent));
    anna.is_lost = true;
    await untilState(page, "anna", "lost");
    anna.is_lost = false;
    await untilState(page, "anna", "moving");
    anna.silence();
    await page.waitForFunction(() => / 0 waiting/.test(document.getElementById("fleet-counts").textContent));
    await page.click("#fleet-rows button");
    assert.equal(await pixelsOf(page, "--warn"), 0);
    await showSpan("hour");

    // The command-line tool reads the states from the same database.
    const states = dotpose("fleet", "history", "--store", database, "--robot", "anna").trim().split("\n").map((line) => JSON.parse(line));
    const lost = states.filter(({ state }) => state === "lost").length;
    assert.ok(states.length > 50 && lost > 0);
    const fraction = (count) => ((100 * count) / states.length).toFixed(1);
    const expected = `: ${fraction(states.length - lost)} % moving, 0 % still, ${fraction(lost)} % lost; up to 100 mm/s.`;
    assert.match(await text(), new RegExp(`^${states.length} states from `));
    assert.ok((await text()).endsWith(expected), `${await text()} instead of ${expected}`);
    assert.ok(await page.isVisible("#fleet-stored-graph"));
    await until(async () => (await pixelsOf(page, "--warn")) > 200, "no track on the map");
    await page.click("#fleet-stored-hide");
    await until(async () => (await pixelsOf(page, "--warn")) === 0, "the track is not hidden");
    await page.waitForSelector("#fleet-stored-figure", { state: "hidden" });

    await page.selectOption("#fleet-stored-span", "free");
    await page.fill("#fleet-stored-from", "2001-02-03T04:05:06");
    await page.fill("#fleet-stored-to", "2001-02-04T04:05:06");
    await showSpan("free");
    assert.equal(await text(), "There are no states in this time.");
    await page.fill("#fleet-stored-to", "2001-01-01T00:00:00");
    await showSpan("free");
    assert.match(await text(), /"from" must be before "to"/);
    await page.fill("#fleet-stored-to", "2003-01-01T00:00:00");
    await showSpan("free");
    assert.match(await text(), /more than 31 days; dotpose fleet history reads/);
    await showSpan("day");
    await requireAccessible(page);
    assert.deepEqual(complaints, []);
    await page.close();
    await stop();
});

test("the graph of a robot that sends rarely has no gaps", async () => {
    new Robot("anna", {}, 600);
    const { url, stop } = await fleet(["--store", join(folder, "rare.db")]);
    const { page } = await open(browser.context, url);
    await untilState(page, "anna", "moving");
    await page.click("#fleet-rows button");
    await page.waitForFunction(() => Number(document.getElementById("fleet-robot-messages").textContent) >= 8);
    await page.waitForFunction(() => / 0 waiting/.test(document.getElementById("fleet-counts").textContent));
    await page.click("#fleet-stored-form button[type=submit]");
    await page.waitForSelector("#fleet-stored-figure", { state: "visible" });
    assert.equal(await emptyShare(page), 0);
    await page.close();
    await stop();
});

test("the trail of a robot on a small circle is round up to the robot", async () => {
    const [radius_m, rate_hz, period_ms] = [0.02, 0.7, 50];
    const robot = new Robot("anna", {}, period_ms);
    robot.path = (n) => {
        const angle = (2 * Math.PI * rate_hz * n * period_ms) / 1000;
        return [0.3 + radius_m * Math.cos(angle), 0.3 + radius_m * Math.sin(angle)];
    };
    const { url, stop } = await fleet();
    const { page } = await open(browser.context, url);
    await untilState(page, "anna", "moving");
    await untilInView(page, 1);
    await page.click("#fleet-fit");
    await page.waitForTimeout(2000);
    // Measures the line segments that extend the trails. Trails are recognised by their opacity.
    const longest = await page.evaluate(async () => {
        const { moveTo, lineTo } = CanvasRenderingContext2D.prototype;
        const [segments, xs] = [[], []];
        let last = null;
        const takes = (context) => context.canvas.id === "fleet-map" && Math.abs(context.globalAlpha - 0.35) < 0.01;
        CanvasRenderingContext2D.prototype.moveTo = function (x, y) {
            if (takes(this)) last = [x, y];
            return moveTo.call(this, x, y);
        };
        CanvasRenderingContext2D.prototype.lineTo = function (x, y) {
            if (takes(this)) {
                segments.push(Math.hypot(x - last[0], y - last[1]));
                xs.push(x);
                last = [x, y];
            }
            return lineTo.call(this, x, y);
        };
        await new Promise((resolve) => setTimeout(resolve, 4000));
        const radius = (Math.max(...xs) - Math.min(...xs)) / 2;
        return { fraction: Math.max(...segments) / radius, count: segments.length };
    });
    // Between two states, the robot moves by 0.22 times the radius of its circle. The limit is 1 radius, because some
    // states are not drawn.
    assert.ok(longest.count > 100 && longest.fraction < 1, JSON.stringify(longest));
    await page.close();
    await stop();
});

test("the chosen robot has height and tilt of its camera", async () => {
    const [anna, bert, carl] = ["anna", "bert", "carl"].map((name, i) => new Robot(name, { y_m: 0.1 * i }));
    // The camera looks down, and is tilted about the y axis of the world. The page shows the tracked pose rather than
    // the pose from the newest frame.
    const camera = (z, tilt_deg) => {
        const half = (tilt_deg * Math.PI) / 360;
        return { x: 0.1, y: 0, z, orientation: { x: Math.cos(half), y: 0, z: -Math.sin(half), w: 0 } };
    };
    anna.more = { cameraPose: camera(0.03, 5), cameraTrack: camera(0.0235, 20) };
    carl.more = { cameraPose: { ...camera(0.03, 5), orientation: { x: 0, y: 0, z: 0, w: 0 } } };
    const { url, stop } = await fleet();
    const { page } = await open(browser.context, url);
    const shows = (text) => page.waitForFunction((wanted) => document.getElementById("fleet-robot-space").textContent === wanted, text);
    await untilState(page, "anna", "moving");
    await page.click("#fleet-rows button:text-is('anna')");
    await shows("23.500 mm high, tilted by 20.00°");
    assert.equal(await page.isVisible("#fleet-robot-in-space"), true);
    anna.more = { cameraPose: camera(0.03, 5) };
    await shows("30.000 mm high, tilted by 5.00°");
    await audit(page);
    anna.is_lost = true;
    await shows("–");
    await untilState(page, "bert", "moving");
    await page.click("#fleet-rows button:text-is('bert')");
    await page.waitForFunction(() => document.getElementById("fleet-robot-name").textContent === "bert");
    assert.equal(await page.isHidden("#fleet-robot-in-space"), true);
    assert.equal(await rowOf(page, "carl"), undefined, "a rotation that is none is refused");
    await page.close();
    await stop();
});
