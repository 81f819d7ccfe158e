// Takes the screenshots for docs/web.md and docs/fleet.md. Run `node tools/take_live_pictures.mjs [PART]` after
// building the tool. PART is watch, sheets, stitch or fleet. With DOTPOSE_PICTURES=../docs/pictures,
// test/calibration.test.mjs takes the screenshots of the calibration page. Needs ffmpeg.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { dotpose, kTool, launch, open } from "../test/browser.mjs";
import { makeSeamFrames } from "../test/seam_frames.mjs";
import { watchSource } from "../test/watch.mjs";
import { takeForms } from "./forms.mjs";

const kPictures = fileURLToPath(new URL("../../docs/pictures/", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "dotpose-pictures-"));
const browser = await launch({ viewport: { width: 1200, height: 900 }, reducedMotion: "reduce" });
const programs = [];
// Changes to the folder that contains the files. The pages show file names exactly as given on the command line, and
// the screenshots should not contain the path of the folder.
process.chdir(folder);

function pause(seconds) {
    return new Promise((resolve) => setTimeout(resolve, 1000 * seconds));
}

function start(command, ...args) {
    const program = spawn(command, args, { stdio: ["pipe", "ignore", "pipe"], env: { ...process.env, PATH: `${process.env.PATH}:/usr/sbin` } });
    const started = { program, messages: "" };
    program.stderr.on("data", (data) => (started.messages += data));
    programs.push(program);
    return started;
}

/** Creates a sheet file with four sheets whose poses in the world are known, and a video of a drive over them. */
function makeDrive() {
    const sheets = "sheets.json";
    ["table", "shelf", "door", "dock"].forEach((name, i) => {
        dotpose("print", "-o", "page.pdf", "--paper", "120x100", "--sheets", sheets, "--name", name);
        dotpose("sheets", "place", name, "--sheets", sheets, "--x", String(130 * (i % 2)), "--y", String(-110 * Math.floor(i / 2)), "--yaw", String([0, 4, -3, 0][i]));
    });
    const video = "drive.mp4";
    const scene = ["--size", "320x240", "--mm-per-px", "0.03", "--seed", "11", "--frames", "1000"];
    dotpose("simulate", "--drive", "--sheets", sheets, "-o", video, ...scene);
    return { sheets, video };
}

const kParts = {
    async watch() {
        const { sheets, video } = makeDrive();
        const options = ["--sheets", sheets, "--log", "run.csv", "--robot", "anna"];
        const run = await watchSource([video, "--realtime", "--fps", "20"], options);
        const { page } = await open(browser.context, run.url);
        await page.waitForFunction(() => document.getElementById("live-counts").textContent.startsWith("frame"));
        await pause(8);
        await page.click("#live-record");
        await pause(11);
        const ready = () =>
            page.waitForFunction(() => {
                const number = (id) => Number.parseFloat(document.getElementById(id).textContent);
                return number("live-dots") >= 250 && number("live-rate") > 15;
            });
        await takeForms(page, kPictures, "web", { ready });
        await page.close();
        await run.stop();
    },
    async sheets() {
        const { sheets, video } = makeDrive();
        const run = await watchSource([video, "--realtime", "--fps", "20"], ["--sheets", sheets, "--web-edit-sheets", "--robot", "anna"]);
        const { page } = await open(browser.context, `${run.url}#sheets`);
        await page.getByRole("button", { name: "dock", exact: true }).click();
        await page.fill("#place-yaw", "-4");
        await page.click("#place-form button[type=submit]");
        await pause(3);
        await takeForms(page, kPictures, "web-sheets", { fullPhone: false });
        await page.close();
        await run.stop();
    },
    async stitch() {
        const { file, frames } = makeSeamFrames(join(folder, "seam"));
        const run = await watchSource(["-", "--size", "376x240", "--fps", "10"], ["--sheets", file, "--web-edit-sheets", "--robot", "anna"]);
        let next = 0;
        const timer = setInterval(() => run.input.write(frames[next++ % frames.length]), 100);
        const { page } = await open(browser.context, `${run.url}#sheets`);
        await page.click("#stitch-start");
        await page.waitForSelector("#stitch-sheets tr");
        await pause(5);
        await takeForms(page, kPictures, "web-stitch");
        clearInterval(timer);
        await page.close();
        await run.stop();
    },
    async fleet() {
        const port = await new Promise((resolve) => {
            const server = createServer().listen(0, "127.0.0.1", () => {
                const free = server.address().port;
                server.close(() => resolve(free));
            });
        });
        writeFileSync(join(folder, "mosquitto.conf"), `listener ${port} 127.0.0.1\nallow_anonymous true\n`);
        start("mosquitto", "-c", join(folder, "mosquitto.conf"));
        await pause(1);
        const broker = `mqtt://127.0.0.1:${port}`;
        const fleet = start(kTool, "fleet", "--mqtt", broker, "--web", "0", "--store", join(folder, "fleet.db"));
        while (!/the page is at (\S+)/.test(fleet.messages)) await pause(0.1);
        const load = (robots, seconds) => start(join(dirname(kTool), "dotpose_fleet_load"), "--port", String(port), "--robots", String(robots), "--hz", "10", "--seconds", String(seconds));
        const all = load(60, 600);
        await pause(16);
        const { page } = await open(browser.context, /the page is at (\S+)/.exec(fleet.messages)[1]);
        await page.click("#fleet-rows button:text-is('robot7')");
        await page.waitForSelector("#fleet-stored", { state: "visible" });
        // After the size of the page has changed, the map shows the whole track only if the form is submitted again.
        const ready = async () => {
            await page.click("#fleet-stored-form button[type=submit]");
            await page.waitForSelector("#fleet-stored-figure", { state: "visible" });
            await page.evaluate(() => scrollTo(0, 0));
            await pause(1);
        };
        await takeForms(page, kPictures, "fleet-history", { ready });
        await page.click("#fleet-stored-hide");
        await page.click("#fleet-fit");
        all.program.kill();
        load(48, 600);
        await pause(22);
        await takeForms(page, kPictures, "fleet");
        await page.close();
    },
};

try {
    for (const [name, part] of Object.entries(kParts)) {
        if (process.argv[2] && process.argv[2] !== name) continue;
        rmSync(join(folder, "sheets.json"), { force: true });
        await part();
    }
} finally {
    await browser.close();
    for (const program of programs) program.kill("SIGKILL");
    rmSync(folder, { recursive: true, force: true });
}
