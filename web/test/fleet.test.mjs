// Tests the page of `dotpose fleet --web` with robots on a real broker, and that of `dotpose listen --web`. A robot is a mosquitto_pub
// with a last will, so it can be killed and stopped like the program of a robot.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { connect, createServer } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, afterEach, before, beforeEach, test } from "node:test";
import { audit, requireAccessible } from "./accessible.mjs";
import { dotpose, kTool, launch, open } from "./browser.mjs";
import { readCsv } from "./clip.mjs";

const kLoad = join(dirname(kTool), "dotpose_fleet_load");
const kSilentAfter_s = 3;
/** Time that the page may need after the limit of a condition. */
const kShown_s = 2;

let folder;
let browser;
let broker;
const programs = [];
const robots = [];

function freePort() {
    return new Promise((resolve) => {
        const server = createServer();
        server.listen(0, "127.0.0.1", () => {
            const { port } = server.address();
            server.close(() => resolve(port));
        });
    });
}

function run(command, ...args) {
    const program = spawn(command, args, { stdio: ["pipe", "ignore", "pipe"], env: { ...process.env, PATH: `${process.env.PATH}:/usr/sbin` } });
    const run = { program, messages: "", ended: new Promise((resolve) => program.on("close", resolve)) };
    program.stderr.on("data", (data) => (run.messages += data));
    program.stdin.on("error", () => {}); // a killed robot
    programs.push(run);
    return run;
}

async function until(condition, what) {
    const end = Date.now() + 60_000;
    for (;;) {
        const result = await condition();
        if (result) return result;
        assert.ok(Date.now() < end, what);
        await new Promise((resolve) => setTimeout(resolve, 20));
    }
}

/** Each test has its own broker, because a broker remembers the robots that were killed. */
async function startBroker() {
    const port = await freePort();
    const settings = ["allow_anonymous true", "max_inflight_messages 1000", "max_queued_messages 100000", "set_tcp_nodelay true"];
    const file = join(folder, "mosquitto.conf");
    writeFileSync(file, [`listener ${port} 127.0.0.1`, ...settings].join("\n"));
    const { program } = run("mosquitto", "-c", file);
    const answers = () =>
        new Promise((resolve) => {
            const socket = connect(port, "127.0.0.1", () => resolve(true)).on("error", () => resolve(false));
            socket.on("connect", () => socket.end());
        });
    await until(answers, "mosquitto does not start");
    return { port, url: `mqtt://127.0.0.1:${port}`, stop: () => program.kill() };
}

/** Starts `dotpose fleet --web`. Returns the address of the page and a function that ends it. */
async function fleet(options = [], port = 0) {
    const always = ["--mqtt", broker.url, "--web", String(port), "--silent-after", String(kSilentAfter_s), ...options];
    const started = run(kTool, "fleet", ...always);
    const url = await until(() => /the page is at (\S+)/.exec(started.messages)?.[1], "no page");
    const stop = async () => {
        started.program.kill("SIGINT");
        assert.equal(await started.ended, 0, started.messages);
    };
    return { url, stop };
}

/** A robot that drives along x by 10 mm from state to state, usually ten times per second. */
class Robot {
    constructor(name, place = {}, period_ms = 100) {
        this.name = name;
        this.place = { map: "hall", sheet: "", y_m: 0.1, ...place };
        this.number = 0;
        this.is_lost = false;
        /** Further members of localized states. */
        this.more = {};
        const connection = `uagv/v2/dotpose/${name}/connection`;
        const will = JSON.stringify({ headerId: 0, timestamp: new Date().toISOString(), connectionState: "CONNECTIONBROKEN" });
        this.run = run(
            "mosquitto_pub",
            ...["-p", String(broker.port), "-t", `uagv/v2/dotpose/${name}/visualization`, "-l"],
            ...["--will-topic", connection, "--will-payload", will, "--will-retain"],
        );
        this.timer = setInterval(() => this.send(), period_ms);
        robots.push(this);
    }
    send() {
        const { map, sheet, y_m } = this.place;
        const x_m = 0.1 + 0.01 * this.number;
        const common = { headerId: this.number++, timestamp: new Date().toISOString(), serialNumber: this.name, ...(sheet ? { sheet } : {}) };
        const agvPosition = { mapId: map, x: x_m, y: y_m, theta: 0, deviationRange: 1e-6 };
        const state = this.is_lost
            ? { ...common, state: "lost", reason: "too_few_dots" }
            : { ...common, state: "moving", agvPosition, velocity: { vx: 0.1, vy: 0, omega: 0 }, ...this.more };
        this.run.program.stdin.write(`${JSON.stringify(state)}\n`);
    }
    silence() {
        clearInterval(this.timer);
    }
    kill() {
        this.silence();
        this.run.program.kill("SIGKILL");
    }
}

/** Returns the cells of a robot's row, or undefined. */
function rowOf(page, name) {
    return page.evaluate((wanted) => {
        for (const row of document.getElementById("fleet-rows").rows)
            if (row.cells[0].textContent === wanted) return [...row.cells].map((cell) => cell.textContent);
        return undefined;
    }, name);
}

async function untilState(page, name, state) {
    await until(async () => (await rowOf(page, name))?.[1].endsWith(state), `${name} is not ${state}`);
    return rowOf(page, name);
}

async function untilInView(page, count) {
    await page.waitForFunction((wanted) => document.getElementById("fleet-in-view").textContent.startsWith(`${wanted} in view`), count);
}

before(async () => {
    folder = mkdtempSync(join(tmpdir(), "dotpose-fleet-"));
    browser = await launch({ viewport: { width: 1300, height: 900 } });
});
beforeEach(async () => {
    broker = await startBroker();
});
afterEach(() => {
    for (const robot of robots.splice(0)) robot.kill();
    broker.stop();
});
after(async () => {
    await browser?.close();
    for (const { program } of programs) program.kill("SIGKILL");
    if (folder) rmSync(folder, { recursive: true, force: true });
});

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
    // Robots that need attention are first.
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
    // The broker no longer retains messages of the robot.
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

/** Returns the number of pixels of the map that have a colour of the style sheet. */
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

/** Returns the share of the columns of the graph's lower band that show no state. */
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

    // The command line reads the same states.
    const states = dotpose("fleet", "history", "--store", database, "--robot", "anna").trim().split("\n").map((line) => JSON.parse(line));
    const lost = states.filter(({ state }) => state === "lost").length;
    assert.ok(states.length > 50 && lost > 0);
    const share = (count) => ((100 * count) / states.length).toFixed(1);
    const expected = `: ${share(states.length - lost)} % moving, 0 % still, ${share(lost)} % lost; up to 100 mm/s.`;
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

test("the chosen robot has height and tilt of its camera", async () => {
    const [anna, bert, carl] = ["anna", "bert", "carl"].map((name, i) => new Robot(name, { y_m: 0.1 * i }));
    // The camera looks down, and is turned about the y axis of the world. Its track is preferred to the newest frame.
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
        // The map is cleared once for each frame.
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
    // Only the robots in view are sent.
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
    // A single robot is in the middle, or drives there, because the map shows all robots.
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
