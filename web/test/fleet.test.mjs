// Tests the page of `dotpose fleet --web` with robots on a real broker, and the page of `dotpose listen --web`.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { audit } from "./accessible.mjs";
import { dotpose, kTool, open } from "./browser.mjs";
import { readCsv } from "./clip.mjs";
import { broker, browser, fleet, folder, kLoad, kShown_s, kSilentAfter_s, Robot, rowOf, run, until, untilInView, untilState } from "./fleet_robots.mjs";

test("a robot that is killed, silenced, lost and removed is shown so", async () => {
    const robots = Object.fromEntries(["anna", "bert", "carl", "dora"].map((name, i) => [name, new Robot(name, { y_m: 0.1 * i })]));
    const { url, stop } = await fleet();
    const { page, complaints } = await open(browser.context, url);
    for (const name of Object.keys(robots)) await untilState(page, name, "moving");
    await untilInView(page, 4);
    const [, , , age, x, , , speed, missed, place] = await rowOf(page, "anna");
    assert.match(age, /^\d\.\d s$/);
    assert.ok(Number(x) >= 100);
    assert.deepEqual([speed, missed, place], ["100", "0", "hall"]);

    const limit = async (action, name, state, limit_s) => {
        const begun = Date.now();
        action();
        const row = await untilState(page, name, state);
        const taken_s = (Date.now() - begun) / 1000;
        assert.ok(taken_s < limit_s + kShown_s, `${name} is ${state} after ${taken_s} s`);
        return row[2];
    };
    assert.equal(await limit(() => robots.anna.kill(), "anna", "silent", 0), "connection broke");
    assert.equal(await limit(() => (robots.carl.is_lost = true), "carl", "lost", 0), "too few dots");
    assert.equal(await limit(() => robots.bert.silence(), "bert", "silent", kSilentAfter_s), "no message");
    // Robots that need attention are listed first.
    const names = await page.$$eval("#fleet-rows th", (cells) => cells.map((cell) => cell.textContent));
    assert.deepEqual(names, ["anna", "bert", "carl", "dora"]);
    const alerts = () => page.$$eval("#fleet-alerts li", (items) => items.map((item) => item.textContent.replace(/^[\d:]+/, "")));
    await until(async () => (await alerts()).length === 3, "three alerts");
    assert.deepEqual((await alerts()).sort(), [
        "annamoving → silent, connection broke, hall",
        "bertmoving → silent, no message, hall",
        "carlmoving → lost, too few dots, hall",
    ]);

    await page.click("#fleet-rows button:text-is('anna')");
    await page.waitForFunction(() => document.getElementById("fleet-robot-name").textContent === "anna");
    assert.equal(await page.textContent("#fleet-robot-state"), "✕ silent: connection broke");
    assert.equal(await page.locator("#fleet-robot-events li").count(), 1);
    await page.click("#fleet-remove");
    await page.click("#fleet-keep");
    await page.click("#fleet-remove");
    assert.match(await page.textContent("#fleet-removal-title"), /^Remove anna\?$/);
    const begun = Date.now();
    await page.click("#fleet-remove-now");
    await until(async () => (await rowOf(page, "anna")) === undefined, "anna is not removed");
    assert.ok(Date.now() - begun < 1000 * kShown_s);
    await page.waitForSelector("#fleet-robot", { state: "hidden" });
    await until(async () => (await alerts())[0]?.startsWith("annasilent → removed"), "the removal is no alert");
    // The broker no longer retains messages from the robot.
    assert.ok(!dotpose("fleet", "--mqtt", broker.url, "--seconds", "0.5").includes("anna"));
    assert.deepEqual(complaints, []);
    await page.close();
    await stop();
});

test("robots on sheets that the file does not contain are listed with what they send", async () => {
    const sheets = join(folder, "hall.json");
    dotpose("print", "-o", join(folder, "dock.pdf"), "--sheets", sheets, "--name", "dock");
    dotpose("sheets", "place", "dock", "--x", "0", "--y", "300", "--yaw", "0", "--sheets", sheets);
    new Robot("known", { sheet: "dock" });
    new Robot("wrong-sheet", { sheet: "dock 7" });
    new Robot("wrong-map", { map: "cellar", sheet: "shelf" });
    const { url, stop } = await fleet(["--sheets", sheets]);
    const { page, complaints } = await open(browser.context, url);
    await page.waitForFunction(() => document.getElementById("fleet-chip-unknown").textContent === "□ 2 on unknown sheets");
    await page.click("#fleet-chip-unknown");
    await page.waitForFunction(() => document.getElementById("fleet-rows").rows.length === 2);
    assert.equal((await rowOf(page, "wrong-sheet"))[9], "hall / dock 7 (not in the sheet file)");
    assert.equal((await rowOf(page, "wrong-map"))[9], "cellar / shelf (not in the sheet file)");
    await untilInView(page, 2);
    await page.selectOption("#fleet-maps", "cellar");
    await untilInView(page, 1);
    assert.deepEqual(complaints, []);
    await page.close();
    await stop();
});

test("the table is filtered, ordered naturally and turned page by page", async () => {
    const load = run(kLoad, "--port", String(broker.port), "--robots", "120", "--hz", "2", "--seconds", "60");
    const { url, stop } = await fleet();
    const { page } = await open(browser.context, url);
    await page.selectOption("#fleet-order", "name");
    await page.waitForFunction(() => document.getElementById("fleet-range").textContent === "1 to 25 of 120");
    const names = () => page.$$eval("#fleet-rows th", (cells) => cells.map((cell) => cell.textContent));
    assert.deepEqual(await names(), Array.from({ length: 25 }, (_, i) => `robot${i}`));
    await page.click("#fleet-next");
    await page.waitForFunction(() => document.getElementById("fleet-range").textContent === "26 to 50 of 120");
    assert.equal((await names())[0], "robot25");
    await page.fill("#fleet-filter", "BOT11");
    await page.waitForFunction(() => document.getElementById("fleet-range").textContent === "1 to 11 of 11");
    assert.deepEqual(await names(), ["robot11", ...Array.from({ length: 10 }, (_, i) => `robot${110 + i}`)]);
    await page.selectOption("#fleet-show", "lost");
    await page.waitForFunction(() => document.getElementById("fleet-range").textContent === "no robots");
    load.program.kill();
    await page.close();
    await stop();
});

test("names from the network are text", async () => {
    const hostile = "<img src=x onerror=alert(1)>";
    new Robot(hostile, { map: "<script>alert(2)<\/script>", sheet: "\u202e\n<b>../../etc/passwd" });
    const { url, stop } = await fleet();
    const { page, complaints } = await open(browser.context, url);
    page.on("dialog", () => complaints.push("a dialog"));
    await untilState(page, hostile, "moving");
    assert.equal((await rowOf(page, hostile))[9], "<script>alert(2)<\/script> / \ufffd\ufffd<b>../../etc/passwd");
    await page.click("#fleet-rows button");
    await page.waitForFunction((name) => document.getElementById("fleet-robot-name").textContent === name, hostile);
    await untilInView(page, 1);
    assert.equal(await page.evaluate(() => document.querySelectorAll("img:not(.brand img), main script, main b").length), 0);
    assert.deepEqual(complaints, []);
    await page.close();
    await stop();
});

test("2,000 robots are drawn", async (t) => {
    const { url, stop } = await fleet();
    const load = run(kLoad, "--port", String(broker.port), "--robots", "2000", "--hz", "20", "--seconds", "60");
    const { page, complaints } = await open(browser.context, url);
    await untilInView(page, 2000);
    await page.evaluate(() => {
        // Counts how often the map is drawn. The map is cleared once before each drawing.
        const { clearRect } = CanvasRenderingContext2D.prototype;
        globalThis.drawn = 0;
        CanvasRenderingContext2D.prototype.clearRect = function (...all) {
            if (this.canvas.id === "fleet-map") ++globalThis.drawn;
            return clearRect.apply(this, all);
        };
    });
    const begun = Date.now();
    await page.waitForFunction(() => globalThis.drawn >= 60);
    const rate_hz = (60_000 / (Date.now() - begun)).toFixed(1);
    t.diagnostic(`drawn ${rate_hz} times a second, ${await page.textContent("#fleet-rate")}; ${await page.textContent("#fleet-counts")}`);
    // The program sends only the robots in view.
    await page.focus("#fleet-map");
    for (let i = 0; i < 25; ++i) await page.click("#fleet-closer");
    await page.waitForFunction(() => Number.parseInt(document.getElementById("fleet-in-view").textContent, 10) < 20);
    await page.click("#fleet-fit");
    await untilInView(page, 2000);
    assert.deepEqual(complaints, []);
    await page.close();
    load.program.kill();
    await stop();
});

test("a click on the map chooses a robot, and a restart forgets it", async () => {
    new Robot("anna");
    const { url, stop } = await fleet();
    const { port } = new URL(url);
    const { page } = await open(browser.context, url);
    await untilInView(page, 1);
    const box = await page.locator("#fleet-map").boundingBox();
    // The map is fitted to its only robot, so the robot is near the middle. The click is repeated, because the robot
    // may have moved away in the meantime.
    await until(async () => {
        await page.click("#fleet-fit");
        await page.waitForTimeout(200);
        await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
        return page.locator("#fleet-robot").isVisible();
    }, "no robot is chosen");
    assert.equal(await page.textContent("#fleet-robot-name"), "anna");
    await stop();
    await page.waitForFunction(() => document.getElementById("live-status").textContent === "no connection to dotpose");
    await page.waitForSelector("#fleet-robot", { state: "hidden" });
    const again = await fleet([], port);
    await page.waitForFunction(() => document.getElementById("live-status").textContent === "live");
    await untilState(page, "anna", "moving");
    await page.close();
    await again.stop();
});

test("the page of listen shows the device", async () => {
    const drive = join(folder, "drive.mp4");
    const packets = join(folder, "packets.bin");
    const sheets = join(folder, "sheets.json");
    dotpose("print", "-o", join(folder, "table.pdf"), "--sheets", sheets, "--name", "table");
    dotpose("simulate", "--drive", "--sheets", sheets, "--frames", "100", "-o", drive, "--size", "320x240", "--mm-per-px", "0.03", "--seed", "11");
    dotpose("watch", drive, "--packets", packets, "--no-window", "-o", "/dev/null");
    const truth = readCsv(readFileSync(drive.replace(".mp4", "-truth.csv"), "utf8")).at(-1);
    const device = run(kTool, "listen", "-", "--robot", "micro", "--web", "0", "-o", "/dev/null");
    const url = await until(() => /the page is at (\S+)/.exec(device.messages)?.[1], "no page");
    device.program.stdin.write(readFileSync(packets));
    const { page, complaints } = await open(browser.context, url);
    await page.waitForSelector("#fleet-robot", { state: "visible" });
    assert.equal(await page.textContent("#fleet-title"), "micro");
    const number = async (id) => Number(await page.textContent(`#fleet-robot-${id}`));
    await until(async () => (await number("messages")) === 100, "100 messages");
    const distance_mm = Math.hypot((await number("x")) - truth.x_mm, (await number("y")) - truth.y_mm);
    assert.ok(distance_mm < 0.05, `${distance_mm} mm`);
    assert.match(await page.textContent("#fleet-robot-place"), /^pattern-/);
    assert.ok(await page.isHidden("#fleet-remove"));
    assert.deepEqual(complaints, []);
    await page.close();
    device.program.stdin.end();
    assert.equal(await device.ended, 0, device.messages);
});

test("axe finds no violation, and nothing is wider than the screen", async () => {
    const anna = new Robot("anna-with-a-long-name-that-does-not-fit-into-a-narrow-column-of-the-table");
    const { url, stop } = await fleet();
    for (const colorScheme of ["light", "dark"]) {
        for (const width of [1300, 390, 320]) {
            const { page } = await open(browser.context, url);
            await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
            await page.setViewportSize({ width, height: 800 });
            await untilInView(page, 1);
            await page.click("#fleet-rows button");
            await page.waitForSelector("#fleet-robot", { state: "visible" });
            anna.is_lost = true;
            await page.waitForSelector("#fleet-alerts li");
            await audit(page);
            await page.click("#fleet-remove");
            await audit(page);
            await page.close();
        }
    }
    await stop();
});
