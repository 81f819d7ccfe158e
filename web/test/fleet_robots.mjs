// Provides a broker, robots and `dotpose fleet --web` for the tests of the page. A robot is a mosquitto_pub process
// with a last will, so it can be stopped or killed like the program of a real robot. Each test file that imports this
// module gets a browser and a folder, and each of its tests gets a broker.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { connect, createServer } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, afterEach, before, beforeEach } from "node:test";
import { kTool, launch } from "./browser.mjs";

export const kLoad = join(dirname(kTool), "dotpose_fleet_load");
export const kSilentAfter_s = 3;
/** Maximum delay, after the time limit of a condition has expired, until the page shows the condition. */
export const kShown_s = 2;

export let folder;
export let browser;
export let broker;
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

export function run(command, ...args) {
    const program = spawn(command, args, { stdio: ["pipe", "ignore", "pipe"], env: { ...process.env, PATH: `${process.env.PATH}:/usr/sbin` } });
    const run = { program, messages: "", ended: new Promise((resolve) => program.on("close", resolve)) };
    program.stderr.on("data", (data) => (run.messages += data));
    program.stdin.on("error", () => {}); // a killed robot
    programs.push(run);
    return run;
}

export async function until(condition, what) {
    const end = Date.now() + 60_000;
    for (;;) {
        const result = await condition();
        if (result) return result;
        assert.ok(Date.now() < end, what);
        await new Promise((resolve) => setTimeout(resolve, 20));
    }
}

/** Starts a broker. Each test has its own broker, because a broker retains the messages of robots that were killed. */
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

/** Starts `dotpose fleet --web`. Returns the address of the page and a function that ends the program. */
export async function fleet(options = [], port = 0) {
    const always = ["--mqtt", broker.url, "--web", String(port), "--silent-after", String(kSilentAfter_s), ...options];
    const started = run(kTool, "fleet", ...always);
    const url = await until(() => /the page is at (\S+)/.exec(started.messages)?.[1], "no page");
    const stop = async () => {
        started.program.kill("SIGINT");
        assert.equal(await started.ended, 0, started.messages);
    };
    return { url, stop };
}

/** A robot that drives along x. Sends a state every `period_ms`, and moves by 10 mm between states. */
export class Robot {
    constructor(name, place = {}, period_ms = 100) {
        this.name = name;
        this.place = { map: "hall", sheet: "", y_m: 0.1, ...place };
        this.number = 0;
        this.is_lost = false;
        /** Returns the position of state n, in m. */
        this.path = (n) => [0.1 + 0.01 * n, this.place.y_m];
        /** Additional members for states that contain a position. */
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
        const { map, sheet } = this.place;
        const [x_m, y_m] = this.path(this.number);
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

/** Returns the cells of a robot's table row, or undefined if there is no such row. */
export function rowOf(page, name) {
    return page.evaluate((wanted) => {
        for (const row of document.getElementById("fleet-rows").rows)
            if (row.cells[0].textContent === wanted) return [...row.cells].map((cell) => cell.textContent);
        return undefined;
    }, name);
}

export async function untilState(page, name, state) {
    await until(async () => (await rowOf(page, name))?.[1].endsWith(state), `${name} is not ${state}`);
    return rowOf(page, name);
}

export async function untilInView(page, count) {
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
