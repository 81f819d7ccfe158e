// Tests the "Look" view with a fake camera that plays a clip of frames with known poses. Tests both methods of reading
// the luma: directly from the camera, and through a canvas.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { dotpose, launch, open, serve } from "./browser.mjs";
import { makeClip, readCsv } from "./clip.mjs";

let folder;
let server;
let browser;
let truth;

before(async () => {
    folder = mkdtempSync(join(tmpdir(), "dotpose-clip-"));
    truth = makeClip(folder, { frames: 8, size: "640x480" });
    server = await serve();
    browser = await launch({ clip: join(folder, "clip.y4m"), viewport: { width: 1200, height: 900 } });
});
after(async () => {
    await browser?.close();
    await server?.close();
    if (folder) rmSync(folder, { recursive: true, force: true });
});

/** Runs the camera until `frames` frames are logged. Returns the log, and the errors and warnings from the page. */
async function runCamera(address, frames) {
    const { page, complaints } = await open(browser.context, server.url + address);
    await page.click("#look-start");
    await page.waitForFunction((n) => parseInt(document.getElementById("look-logged").textContent) >= n, frames, {
        timeout: 60_000,
    });
    const rate = await page.textContent("#look-rate");
    const [file] = await Promise.all([page.waitForEvent("download"), page.click("#look-log")]);
    const log = readFileSync(await file.path(), "utf8");
    return { page, complaints, rate, log };
}

/**
 * Returns the true pose for a line of the log: the pose in the clip that is nearest to the logged pose. This choice is
 * unambiguous, because the positions in the clip are metres apart.
 */
function truthOf(line) {
    const near = (at) => Math.hypot(at.x_mm - line.x_mm, at.y_mm - line.y_mm);
    return truth.reduce((best, at) => (near(at) < near(best) ? at : best));
}

function requireTruth(lines) {
    const seen = new Set();
    for (const line of lines) {
        assert.equal(line.status, "ok", JSON.stringify(line));
        const at = truthOf(line);
        seen.add(at.file);
        const off_mm = Math.hypot(at.x_mm - line.x_mm, at.y_mm - line.y_mm);
        assert.ok(off_mm < 0.005, `position error of ${off_mm} mm in ${at.file}`);
        const turn_deg = ((line.theta_deg - at.theta_deg + 540) % 360) - 180;
        assert.ok(Math.abs(turn_deg) < 0.1, `angle error of ${turn_deg} degrees in ${at.file}`);
    }
    assert.ok(seen.size >= 4, `only ${seen.size} of ${truth.length} frames of the clip were seen`);
}

test("the luma straight from the camera gives the poses of the clip, to the bit those of the tool", async () => {
    const { page, complaints, rate, log } = await runCamera("#look", 25);
    assert.match(rate, /^\d+ frames per second, straight from the camera$/);
    const lines = readCsv(log);
    requireTruth(lines);
    // For frames without a prediction, the pose must equal the pose that the command-line tool computes.
    const first = lines.filter((line) => line.attempt === "first");
    assert.ok(first.length >= 4, `${first.length} frames were read without prediction`);
    for (const line of first) {
        const { tool } = truthOf(line);
        for (const [key, digits] of [["x_mm", 6], ["y_mm", 6], ["theta_deg", 6]])
            assert.equal(Number(line[key]).toFixed(digits), tool[key].toFixed(digits), key);
    }
    assert.deepEqual(complaints, []);
    await page.close();
});

test("the luma by canvas gives the poses of the clip", async () => {
    const { page, complaints, rate, log } = await runCamera("?luma=canvas#look", 15);
    assert.match(rate, /^\d+ frames per second, by canvas$/);
    requireTruth(readCsv(log));
    assert.deepEqual(complaints, []);
    await page.close();
});

test("the columns of a log are keys of the tool's lines", async () => {
    const { page, log } = await runCamera("#look", 2);
    const schema = JSON.parse(readFileSync(new URL("../../docs/schema/lines-1.json", import.meta.url), "utf8"));
    const known = new Set(Object.values(schema.$defs).flatMap(({ properties }) => Object.keys(properties ?? {})));
    // Array fields have one column for each element.
    for (const column of log.split("\n")[0].split(",")) assert.ok(known.has(column.replace(/^(section)_[uv]$/, "$1")), column);
    await page.close();
});

test("the tool replays a log", async () => {
    const { page, log } = await runCamera("#look", 5);
    const path = join(folder, "page.csv");
    writeFileSync(path, log);
    const run = JSON.parse(dotpose("replay", path, "--format", "json"));
    const lines = readCsv(log);
    assert.equal(run.frames, lines.length);
    assert.equal(run.fixes, lines.filter(({ status }) => status === "ok").length);
    assert.equal(run.events.fix, 1);
    const ways_mm = lines.slice(1).map(({ x_mm, y_mm }, i) => Math.hypot(x_mm - lines[i].x_mm, y_mm - lines[i].y_mm));
    assert.ok(Math.abs(run.distance_mm - ways_mm.reduce((sum, way) => sum + way)) < 1e-3, `${run.distance_mm} mm`);
    await page.close();
});

test("a frozen frame is explained step by step, and the camera goes on", async () => {
    const { page } = await runCamera("#look", 3);
    await page.click("#look-freeze");
    const titles = await page.locator("#explain h3").allTextContents();
    assert.deepEqual(titles, ["The frame", "The dots", "The grid", "The symbols", "The place", "The pose"]);
    const frozen = await page.textContent("#look-logged");
    await page.waitForTimeout(500);
    const rest = parseInt(await page.textContent("#look-logged")) - parseInt(frozen);
    assert.ok(rest <= 1, `${rest} frames were read while frozen`);
    await page.keyboard.press("Escape");
    await page.waitForFunction(
        (n) => parseInt(document.getElementById("look-logged").textContent) > n + 3,
        parseInt(frozen),
    );
    await page.close();
});

test("a picture is read, and one of something else gets a hint", async () => {
    const { page } = await open(browser.context, `${server.url}#look`);
    await page.setInputFiles("#look-file", { name: "s.png", mimeType: "image/png", buffer: truth[0].png });
    await page.waitForFunction(() => document.getElementById("look-x").textContent !== "–");
    const x_mm = Number((await page.textContent("#look-x")).replaceAll("\u202f", ""));
    assert.ok(Math.abs(x_mm - truth[0].x_mm) < 0.005, `${x_mm}, not ${truth[0].x_mm}`);
    // The picture is a screenshot of the page's header, which contains no dots.
    const buffer = await page.screenshot({ clip: { x: 0, y: 0, width: 640, height: 200 } });
    await page.setInputFiles("#look-file", { name: "other.png", mimeType: "image/png", buffer });
    await page.waitForFunction(() => document.getElementById("look-x").textContent === "–");
    assert.notEqual(await page.textContent("#look-hint"), "");
    await page.close();
});

/** First cell of the A4 sheet "table". `kOnTable` is the pattern position at the image centre, in cells. */
const kOrigin = [1000, 2000];
const kOnTable = [1200.3, 2300.6];

/** Prints the sheet "table" with the command-line tool. Returns the path of the sheet file. */
function sheetFile() {
    const path = join(folder, "sheets.json");
    rmSync(path, { force: true });
    const sheet = ["--paper", "A4", "--origin", kOrigin.join(), "--name", "table", "--sheets", path];
    dotpose("print", "-o", join(folder, "table.svg"), ...sheet);
    return path;
}

/** Returns frames of a sheet in section 0, 0. `at` is the pattern position at the image centre, in cells. */
function viewsOf(at, size, frames = 1) {
    const still = mkdtempSync(join(folder, "view-"));
    return makeClip(still, { frames, size, options: ["--section", "0,0", "--at", at.join()] });
}

/** Opens a picture, and waits for its result. The picture must be located if `ok` is true, and refused otherwise. */
async function openPicture(page, buffer, ok) {
    await page.setInputFiles("#look-file", { name: "view.png", mimeType: "image/png", buffer });
    await page.waitForFunction((is_ok) => (document.getElementById("look-x").textContent !== "–") === is_ok, ok);
    await page.waitForFunction((is_ok) => document.getElementById("look-hint").hidden === is_ok, ok);
}

test("a small view is located on a known sheet, and only there", async () => {
    const { page, complaints } = await open(browser.context, `${server.url}#look`);
    const [{ png }] = viewsOf(kOnTable, "66x66");
    assert.equal(await page.textContent("#look-known"), "No known sheets");
    assert.equal(await page.isDisabled("#look-only"), true);
    await openPicture(page, png, false);
    assert.equal(await page.textContent("#look-sheet"), "–");

    // The picture is read again when the options change.
    const path = sheetFile();
    await page.setInputFiles("#look-sheets", path);
    await page.waitForFunction(() => document.getElementById("look-known").textContent === "1 known sheet");
    await page.check("#look-only");
    await page.waitForFunction(() => document.getElementById("look-x").textContent !== "–");
    assert.equal(await page.textContent("#look-sheet"), "table");
    assert.equal(await page.textContent("#look-prior"), "only known sheets");
    assert.equal(await page.textContent("#look-map-name"), "On the sheet “table”");
    const [{ first_x_mm, first_y_mm }] = JSON.parse(readFileSync(path, "utf8")).sheets;
    const expected_mm = kOnTable.map((cell, i) => (cell - kOrigin[i]) * 0.508 + [first_x_mm, first_y_mm][i]);
    const shown_mm = [await page.textContent("#look-x"), await page.textContent("#look-y")].map(Number);
    const off_mm = Math.hypot(shown_mm[0] - expected_mm[0], shown_mm[1] - expected_mm[1]);
    assert.ok(off_mm < 0.02, `${shown_mm}, not ${expected_mm}`);

    const [file] = await Promise.all([page.waitForEvent("download"), page.click("#look-log")]);
    const line = readCsv(readFileSync(await file.path(), "utf8")).at(-1);
    assert.deepEqual([line.prior, line.sheet], ["only_sheets", "table"]);
    assert.ok(Math.abs(line.x_sheet_mm - expected_mm[0]) < 0.02 && Math.abs(line.y_sheet_mm - expected_mm[1]) < 0.02);

    // The "Print" view lists the sheet. After the user removes it there, it is no longer known.
    await page.click("nav [data-view=print]");
    await page.click("[aria-label='Forget the sheet table']");
    await page.click("nav [data-view=look]");
    assert.equal(await page.textContent("#look-known"), "No known sheets");
    await openPicture(page, png, false);
    assert.deepEqual(complaints, []);
    await page.close();
});

test("a fix on no known sheet is shown with a warning", async () => {
    const { page } = await open(browser.context, `${server.url}#look`);
    const [[{ png: known }], [{ png: unknown }]] = [viewsOf(kOnTable, "188x120"), viewsOf([5200.3, 2300.6], "188x120")];
    await page.setInputFiles("#look-sheets", sheetFile());
    await page.waitForFunction(() => document.getElementById("look-known").textContent === "1 known sheet");
    await openPicture(page, known, true);
    assert.equal(await page.textContent("#look-sheet"), "table");
    await page.setInputFiles("#look-file", { name: "unknown.png", mimeType: "image/png", buffer: unknown });
    await page.waitForFunction(() => document.getElementById("look-sheet").textContent === "not known");
    assert.notEqual(await page.textContent("#look-x"), "–");
    assert.equal(await page.textContent("#look-x-name"), "x in the pattern, mm");
    assert.match(await page.textContent("#look-hint"), /^Located, but on no known sheet/);
    assert.equal(await page.evaluate(() => document.getElementById("look-hint").classList.contains("good")), false);
    await page.check("#look-only");
    await page.waitForFunction(() => document.getElementById("look-x").textContent === "–");
    assert.match(await page.textContent("#look-hint"), /^No known sheet has these dots/);
    await page.evaluate(() => localStorage.clear());
    await page.close();
});

test("a file that is not a sheet file is refused with its reason", async () => {
    const { page } = await open(browser.context, `${server.url}#look`);
    const good = JSON.parse(readFileSync(sheetFile(), "utf8"));
    const change = (values) => JSON.stringify({ ...good, sheets: [{ ...good.sheets[0], ...values }] });
    const refused = [
        ["{", "it is not JSON"],
        ["[]", 'its "format" is not "dotpose-sheets"'],
        [JSON.stringify({ ...good, version: 2 }), "its version is 2; this page reads version 1"],
        [change({ columns: "394" }), "sheets[0].columns must be a number"],
        [change({ rows: 7 }), "sheets[0].rows is 7; it must be a whole number from 8 to 410813348"],
        [change({ code: "morse" }), "sheets[0].code is 'morse'; it must be anoto, libdots, microdots"],
        [change({ spacing_mm: 1.016 }), "sheets[0].spacing_mm is 1.016; this page locates sheets with a spacing of 0.508 mm"],
    ];
    for (const [text, reason] of refused) {
        await page.setInputFiles("#look-sheets", { name: "s.json", mimeType: "application/json", buffer: Buffer.from(text) });
        const message = `'s.json' is not read as a sheet file: ${reason}.`;
        await page.waitForFunction((wanted) => document.getElementById("look-hint").textContent === wanted, message);
    }
    assert.equal(await page.textContent("#look-known"), "No known sheets");
    await page.close();
});

test("sheets with the same name are all known, and those with the same dots once", async () => {
    const { page } = await open(browser.context, `${server.url}#look`);
    const good = JSON.parse(readFileSync(sheetFile(), "utf8"));
    const other = { ...good, sheets: [{ ...good.sheets[0], origin_x: 9000 }] };
    for (const [content, known] of [[good, "1 known sheet"], [good, "1 known sheet"], [other, "2 known sheets"]]) {
        const buffer = Buffer.from(JSON.stringify(content));
        await page.setInputFiles("#look-sheets", { name: "s.json", mimeType: "application/json", buffer });
        await page.waitForFunction((text) => document.getElementById("look-known").textContent === text, known);
    }
    await page.click("nav [data-view=print]");
    assert.deepEqual(await page.locator("#print-list strong").allTextContents(), ["table", "table 2"]);
    await page.evaluate(() => localStorage.clear());
    await page.close();
});

for (const address of ["#look", "?luma=canvas#look"]) {
    test(`the camera knows the sheets, ${address}`, async () => {
        const still = mkdtempSync(join(folder, "small-"));
        makeClip(still, { frames: 4, size: "72x72", options: ["--section", "0,0", "--at", kOnTable.join()] });
        const small = await launch({ clip: join(still, "clip.y4m"), viewport: { width: 1200, height: 900 } });
        try {
            const { page } = await open(small.context, server.url + address);
            await page.setInputFiles("#look-sheets", sheetFile());
            await page.waitForFunction(() => document.getElementById("look-known").textContent === "1 known sheet");
            await page.check("#look-only");
            await page.click("#look-start");
            await page.waitForFunction(() => document.getElementById("look-sheet").textContent === "table");
            assert.equal(await page.textContent("#look-prior"), "only known sheets");
        } finally {
            await small.close();
        }
    });
}
