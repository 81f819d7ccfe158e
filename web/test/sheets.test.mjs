// Tests the "Sheets" view on the page of `dotpose watch --web`. The tests read the sheet file with the command-line
// tool, and also change it with the tool while the page is open.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { copyFileSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, beforeEach, test } from "node:test";
import { requireAccessible } from "./accessible.mjs";
import { dotpose, launch, open } from "./browser.mjs";
import { makeSeamFrames } from "./seam_frames.mjs";
import { watchSource } from "./watch.mjs";

const kTable = "<b>table</b>";

let folder;
let browser;
let file;

function sheetOf(name) {
    return JSON.parse(readFileSync(file, "utf8")).sheets.find((sheet) => sheet.name === name);
}

/** Returns the pose of a sheet as `dotpose sheets` prints it. */
function placeOf(name) {
    const text = dotpose("sheets", "show", name, "--sheets", file);
    const found = /corner is at x (\S+) mm, y (\S+) mm in the world, yaw (\S+) deg/.exec(text);
    return found && { x_mm: Number(found[1]), y_mm: Number(found[2]), yaw_deg: Number(found[3]) };
}

function watchDrive(options = ["--web-edit-sheets"]) {
    return watchSource([join(folder, "drive.mp4"), "--realtime", "--fps", "5"], ["--sheets", file, ...options]);
}

async function openSheets(url) {
    const opened = await open(browser.context, `${url}#sheets`);
    await opened.page.waitForSelector("#sheets-list tr");
    return opened;
}

async function select(page, name) {
    await page.getByRole("button", { name, exact: true }).click();
    await page.waitForFunction((text) => document.getElementById("sheet-name").textContent === text, name);
}

function save(page, form) {
    return page.click(`#${form}-form button[type=submit]`);
}

/** Waits for a message on the page, and clears it. */
async function message(page, pattern) {
    await page.waitForFunction((text) => new RegExp(text).test(document.getElementById("sheets-message").textContent), pattern.source);
    await page.evaluate(() => (document.getElementById("sheets-message").textContent = ""));
}

/** Returns a function that converts world coordinates to window coordinates. */
async function mapOf(page) {
    await page.evaluate(() => document.getElementById("sheets-map").scrollIntoView({ block: "center" }));
    const box = await page.locator("#sheets-map").boundingBox();
    const seen = async (u, v) => {
        await page.mouse.move(box.x + u, box.y + v);
        const text = await page.textContent("#sheets-pointer");
        const [, x, y] = /x (\S+), y (\S+) mm/.exec(text);
        return [Number(x), Number(y)];
    };
    const [x0, y0] = await seen(5, 5);
    const [x1] = await seen(305, 5);
    const scale = 300 / (x1 - x0);
    return { at: (x_mm, y_mm) => [box.x + 5 + (x_mm - x0) * scale, box.y + 5 - (y_mm - y0) * scale], mm_per_px: 1 / scale };
}

async function drag(page, from, to) {
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move((from[0] + to[0]) / 2, (from[1] + to[1]) / 2);
    await page.mouse.move(...to);
    await page.mouse.up();
}

/** Sends a command as a page would, and returns the answer. */
function command(page, values) {
    return page.evaluate(
        (sent) =>
            new Promise((resolve) => {
                const socket = new WebSocket(`ws://${location.host}/live`);
                const id = String(Math.random());
                socket.onopen = () => {
                    socket.send(JSON.stringify({ do: "subscribe", topic: "sheet-answers" }));
                    socket.send(JSON.stringify({ ...sent, id }));
                };
                socket.onmessage = ({ data }) => {
                    socket.send(JSON.stringify({ do: "next", topic: "sheet-answers" }));
                    const answer = JSON.parse(data.slice(data.indexOf("\n"))).answers.find((one) => one.id === id);
                    if (answer) socket.close();
                    if (answer) resolve(answer);
                };
            }),
        values,
    );
}

before(async () => {
    folder = mkdtempSync(join(tmpdir(), "dotpose-sheets-"));
    file = join(folder, "sheets.json");
    for (const name of [kTable, "shelf", "door"])
        dotpose("print", "-o", join(folder, "page.pdf"), "--paper", "120x100", "--sheets", file, "--name", name);
    const scene = ["--size", "320x240", "--mm-per-px", "0.03", "--seed", "11", "--frames", "400"];
    dotpose("simulate", "--drive", "--sheets", file, "-o", join(folder, "drive.mp4"), ...scene);
    dotpose("sheets", "place", kTable, "--sheets", file, "--x", "0", "--y", "0", "--yaw", "0");
    dotpose("sheets", "place", "shelf", "--sheets", file, "--x", "150", "--y", "0", "--yaw", "0");
    copyFileSync(file, join(folder, "first.json"));
    browser = await launch({ viewport: { width: 1200, height: 900 }, reducedMotion: "reduce" });
});
beforeEach(() => copyFileSync(join(folder, "first.json"), file));
after(async () => {
    await browser?.close();
    if (folder) rmSync(folder, { recursive: true, force: true });
});

test("a sheet is moved and turned by mouse and keyboard, and the edits are undone", async () => {
    const run = await watchDrive();
    try {
        const { page, complaints } = await openSheets(run.url);
        await select(page, "shelf");
        const { at, mm_per_px } = await mapOf(page);
        await drag(page, at(200, -50), at(230, -70));
        await message(page, /^Saved/);
        const moved = placeOf("shelf");
        assert.ok(Math.abs(moved.x_mm - 180) < 2 * mm_per_px && Math.abs(moved.y_mm + 20) < 2 * mm_per_px, JSON.stringify(moved));
        assert.equal(moved.yaw_deg, 0);

        // The rotation handle is above the middle of the sheet's upper edge. Dragging the handle rotates the sheet
        // about its centre.
        const map = await mapOf(page);
        const middle = map.at(moved.x_mm + 60, moved.y_mm - 50);
        const [u, v] = map.at(moved.x_mm + 60, moved.y_mm);
        await page.keyboard.down("Shift");
        await drag(page, [u, v - 26], [middle[0] - 80, middle[1] - 3]);
        await page.keyboard.up("Shift");
        await message(page, /^Saved/);
        const turned = placeOf("shelf");
        assert.equal(turned.yaw_deg, 90);
        assert.ok(Math.abs(turned.x_mm - (moved.x_mm + 60 - 50)) < 0.2 && Math.abs(turned.y_mm - (moved.y_mm - 50 - 60)) < 0.2, JSON.stringify(turned));

        await page.focus("#sheets-map");
        for (const key of ["ArrowRight", "Shift+ArrowUp", "Alt+ArrowLeft", "r"]) await page.keyboard.press(key);
        await message(page, /^Saved/);
        assert.equal(placeOf("shelf").yaw_deg, 89);
        await page.keyboard.press("Control+z");
        await message(page, /^Undone: place 'shelf'/);
        assert.deepEqual(placeOf("shelf"), turned);
        await page.click("#sheets-undo");
        await message(page, /Undone/);
        assert.deepEqual(placeOf("shelf"), moved);
        await page.click("#sheets-undo");
        await message(page, /Undone/);
        assert.deepEqual(placeOf("shelf"), { x_mm: 150, y_mm: 0, yaw_deg: 0 });
        assert.equal(await page.isDisabled("#sheets-undo"), true);
        await page.click("#sheets-redo");
        await message(page, /Done again/);
        assert.deepEqual(placeOf("shelf"), moved);

        // If the user moves a sheet that has no pose in the world, the sheet gets a pose.
        await select(page, "door");
        assert.equal(placeOf("door"), null);
        await page.focus("#sheets-map");
        await page.keyboard.press("ArrowUp");
        await message(page, /^Saved/);
        assert.notEqual(placeOf("door"), null);
        assert.deepEqual(complaints, []);
        await page.close();
    } finally {
        await run.stop();
    }
});

test("numbers, ruler and offset are saved like on the command line", async () => {
    const run = await watchDrive();
    try {
        const { page, complaints } = await openSheets(run.url);
        await select(page, kTable);
        await page.fill("#place-x", "12.5");
        await page.fill("#place-y", "-3.25");
        await page.fill("#place-yaw", "370");
        await save(page, "place");
        await message(page, /12\.5 mm, y -3\.25 mm in the world, yaw 10 deg/);
        assert.deepEqual(placeOf(kTable), { x_mm: 12.5, y_mm: -3.25, yaw_deg: 10 });

        await page.fill("#scale-measured", "48.5");
        await save(page, "scale");
        await message(page, /print scale x 0\.97, y 0\.97/);
        await page.fill("#scale-measured", "99");
        await page.fill("#scale-nominal", "100");
        await page.selectOption("#scale-along", "y");
        await save(page, "scale");
        await message(page, /print scale x 0\.97, y 0\.99/);
        assert.match(dotpose("sheets", "show", kTable, "--sheets", file), /print scale +x 0\.97, y 0\.99/);
        // A number that the library refuses is reported, and the file is not changed.
        await page.fill("#scale-measured", "900");
        await save(page, "scale");
        await message(page, /^Refused: .*0\.5 to 2/);
        assert.equal(sheetOf(kTable).print_scale_y, 0.99);

        await page.fill("#offset-right", "9.6");
        await page.fill("#offset-below", "10.4");
        await save(page, "offset");
        await message(page, /9\.6 mm right/);
        assert.equal(sheetOf(kTable).first_x_mm, 9.6);
        assert.equal(sheetOf(kTable).first_y_mm, 10.4);
        for (let i = 0; i < 4; ++i) {
            await page.click("#sheets-undo");
            await message(page, /Undone/);
        }
        assert.deepEqual(sheetOf(kTable), JSON.parse(readFileSync(join(folder, "first.json"), "utf8")).sheets[0]);
        assert.deepEqual(complaints, []);
        await page.close();
    } finally {
        await run.stop();
    }
});

test("sheets are renamed and removed like on the command line, and both are undone", async () => {
    const run = await watchDrive();
    const names = () => JSON.parse(readFileSync(file, "utf8")).sheets.map(({ name }) => name);
    try {
        const { page, complaints } = await openSheets(run.url);
        const undo = async (pattern) => {
            await page.click("#sheets-undo");
            await message(page, pattern);
        };
        await select(page, "shelf");
        assert.equal(await page.inputValue("#rename-name"), "shelf");
        await page.fill("#rename-name", "door");
        await save(page, "rename");
        await message(page, /^Refused: .*'door'/);
        await page.fill("#rename-name", "<i>north</i>");
        await save(page, "rename");
        await message(page, /^Saved\. <i>north<\/i>/);
        assert.deepEqual(names(), [kTable, "<i>north</i>", "door"]);
        assert.equal(await page.textContent("#sheet-name"), "<i>north</i>");
        assert.deepEqual(placeOf("<i>north</i>"), { x_mm: 150, y_mm: 0, yaw_deg: 0 });
        await undo(/^Undone: rename 'shelf'/);
        assert.deepEqual(sheetOf("shelf"), JSON.parse(readFileSync(join(folder, "first.json"), "utf8")).sheets[1]);

        await select(page, "shelf");
        await page.click("#sheet-remove");
        await message(page, /^shelf is removed: its cells may be given to other pages/);
        assert.deepEqual(names(), [kTable, "door"]);
        await page.waitForFunction(() => document.getElementById("sheet-name").textContent === "No sheet is selected");
        await undo(/^Undone: remove 'shelf'/);
        assert.deepEqual(names(), [kTable, "door", "shelf"]);
        assert.deepEqual(placeOf("shelf"), { x_mm: 150, y_mm: 0, yaw_deg: 0 });

        // Another program prints a page that uses the cells freed by the removal, so the removal can no longer be
        // undone.
        await select(page, "shelf");
        await page.click("#sheet-remove");
        await message(page, /^shelf is removed/);
        dotpose("print", "-o", join(folder, "page.pdf"), "--paper", "120x100", "--sheets", file, "--name", "window");
        await page.getByRole("button", { name: "window", exact: true }).waitFor();
        await undo(/^Refused: .*'window'.*can no longer be undone/);
        assert.deepEqual(names(), [kTable, "door", "window"]);

        // The only sheet in the file cannot be removed, because the run needs at least one sheet.
        for (const name of ["window", "door"]) {
            await select(page, name);
            await page.click("#sheet-remove");
            await message(page, /is removed/);
        }
        await select(page, kTable);
        await page.click("#sheet-remove");
        await message(page, /^Refused: .* is the only sheet of the file/);
        assert.deepEqual(names(), [kTable]);
        assert.deepEqual(complaints, []);
        await page.close();
    } finally {
        await run.stop();
    }
});

test("changes by other programs appear, and conflicts lose nothing", async () => {
    const run = await watchDrive();
    try {
        const { page } = await openSheets(run.url);
        await select(page, "shelf");
        await page.fill("#place-x", "777");
        dotpose("sheets", "place", "shelf", "--sheets", file, "--x", "333", "--y", "44", "--yaw", "5");
        const list = page.locator("#sheets-list tr", { hasText: "shelf" });
        await list.getByText("333.0, 44.0 mm, 5.0°").waitFor();
        // The number being edited is not overwritten. The other numbers are updated.
        assert.equal(await page.inputValue("#place-x"), "777");
        assert.equal(await page.inputValue("#place-y"), "44");

        // An edit that is based on an earlier revision of the sheet is refused.
        const answer = await command(page, { do: "sheet-place", name: "shelf", revision: 1, x_mm: 1, y_mm: 2, yaw_deg: 3 });
        assert.equal(answer.is_ok, false);
        assert.match(answer.message, /'shelf' was changed by someone else/);
        assert.deepEqual(placeOf("shelf"), { x_mm: 333, y_mm: 44, yaw_deg: 5 });

        // The first attempt to save values that were typed before the change is refused. A second attempt saves them.
        await save(page, "place");
        await message(page, /^Refused: 'shelf' was changed by someone else/);
        assert.deepEqual(placeOf("shelf"), { x_mm: 333, y_mm: 44, yaw_deg: 5 });
        assert.equal(await page.inputValue("#place-x"), "777");

        // An edit that another program has overwritten cannot be undone.
        await save(page, "place");
        await message(page, /x 777 mm, y 44 mm/);
        dotpose("sheets", "place", "shelf", "--sheets", file, "--x", "1", "--y", "2", "--yaw", "3");
        await page.click("#sheets-undo");
        await message(page, /^Refused: 'shelf' was changed by someone else since/);
        assert.deepEqual(placeOf("shelf"), { x_mm: 1, y_mm: 2, yaw_deg: 3 });

        // While another program holds the lock, an edit is refused, and the typed number is not lost.
        const lock = spawn("flock", [join(folder, ".sheets.json.lock"), "sleep", "60"], { stdio: "ignore", detached: true });
        await new Promise((resolve) => setTimeout(resolve, 500));
        await page.fill("#place-x", "55");
        await save(page, "place");
        await message(page, /^Refused: .*another program has been changing it/);
        assert.equal(await page.inputValue("#place-x"), "55");
        process.kill(-lock.pid);
        await save(page, "place");
        await message(page, /x 55 mm/);
        assert.deepEqual(placeOf("shelf"), { x_mm: 55, y_mm: 2, yaw_deg: 3 });
        await page.close();
    } finally {
        await run.stop();
    }
});

test("the robot is followed at the new place of its sheet", async () => {
    const run = await watchDrive();
    try {
        const { page } = await openSheets(run.url);
        await page.waitForFunction(() => document.getElementById("live-x-name").textContent.includes("world"));
        const x_mm = () => page.evaluate(() => Number(document.getElementById("live-x").textContent.replace(/[^-.\d]/g, "")));
        assert.ok((await x_mm()) < 300);
        for (const name of [kTable, "shelf", "door"]) {
            await select(page, name);
            for (const id of ["#place-y", "#place-yaw"]) await page.fill(id, "0");
            await page.fill("#place-x", "50000");
            await save(page, "place");
            await message(page, /x 50000 mm/);
        }
        await page.waitForFunction(() => document.getElementById("live-x").textContent.startsWith("50"));
        assert.ok((await x_mm()) > 50000);
        await page.close();
    } finally {
        await run.stop();
    }
});

test("sheets are printed and printed again", async () => {
    const run = await watchDrive();
    try {
        const { page, complaints } = await openSheets(run.url);
        const reprint = join(folder, "reprint.pdf");
        const download = async (act) => {
            const [got] = await Promise.all([page.waitForEvent("download"), act()]);
            return { name: got.suggestedFilename(), bytes: readFileSync(await got.path()), path: await got.path() };
        };
        await select(page, kTable);
        const again = await download(() => page.click("#sheet-reprint"));
        assert.equal(again.name, "_b_table__b_.pdf");
        dotpose("sheets", "reprint", kTable, "--sheets", file, "-o", reprint);
        assert.ok(again.bytes.equals(readFileSync(reprint)));
        execFileSync("qpdf", ["--check", again.path]);

        await page.fill("#new-name", "long shelf");
        await page.selectOption("#new-paper", "A3");
        await page.fill("#new-spacing", "0.6");
        await page.check("#new-landscape");
        const made = await download(() => page.click("#new-sheet button[type=submit]"));
        assert.equal(made.name, "long_shelf.pdf");
        const entry = sheetOf("long shelf");
        assert.equal(entry.reserved, undefined);
        assert.deepEqual([entry.width_mm, entry.height_mm, entry.spacing_mm], [420, 297, 0.6]);
        dotpose("sheets", "reprint", "long shelf", "--sheets", file, "-o", reprint);
        assert.ok(made.bytes.equals(readFileSync(reprint)));
        // The print command shown for the sheet prints the same dots as the downloaded file.
        const [, ...words] = entry.print.command.split(" ");
        execFileSync(process.env.DOTPOSE_TOOL, words, { cwd: folder });
        const sizes = [made.path, join(folder, "long_shelf.pdf")].map((pdf) => dotsOf(pdf));
        assert.equal(sizes[0], sizes[1]);
        assert.equal(await page.textContent("#sheet-name"), "long shelf");

        // The name is already in use.
        await page.click("#new-sheet button[type=submit]");
        await message(page, /^Refused: there already is a sheet 'long shelf'/);
        assert.deepEqual(complaints, []);
        await page.close();
    } finally {
        await run.stop();
    }
});

/** Renders a PDF in greyscale. Returns the first 100,000 bytes, which show the top of the first page. */
function dotsOf(pdf) {
    return execFileSync("pdftoppm", ["-r", "100", "-gray", pdf], { maxBuffer: 1 << 26 }).toString("latin1").slice(0, 100_000);
}

test("the places of sheets are measured with the running camera", async () => {
    const seam = makeSeamFrames(join(folder, "seam"));
    file = seam.file;
    const run = await watchSource(["-", "--size", "376x240", "--fps", "20"], ["--sheets", file, "--web-edit-sheets"]);
    let number = 0;
    const camera = setInterval(() => run.input.write(seam.frames[number++ % seam.frames.length]), 50);
    try {
        const { page, complaints } = await openSheets(run.url);
        assert.equal(placeOf("right"), null);
        await page.click("#stitch-start");
        await page.locator("#stitch-pairs", { hasText: "left – right" }).waitFor();
        await page.locator("#stitch-frames", { hasText: /^\d{2,} of/ }).waitFor();
        assert.match(await page.textContent("#stitch-sheets"), /left.*keeps its place/);
        await requireAccessible(page);
        // Discarded poses are not written.
        await page.click("#stitch-discard");
        await page.waitForSelector("#stitch-start:visible");
        assert.equal(placeOf("right"), null);
        await page.click("#stitch-start");
        await page.locator("#stitch-frames", { hasText: /^\d{2,} of/ }).waitFor();
        await page.click("#stitch-accept");
        await message(page, /Saved the measured places of 2 sheets/);
        const place = placeOf("right");
        assert.ok(Math.hypot(place.x_mm - seam.right.x_mm, place.y_mm - seam.right.y_mm) < 0.05, JSON.stringify(place));
        assert.ok(Math.abs(place.yaw_deg - seam.right.yaw_deg) < 0.1, JSON.stringify(place));
        await page.click("#sheets-undo");
        await message(page, /Undone: measured places/);
        assert.equal(placeOf("right"), null);
        assert.deepEqual(complaints, []);
        await page.close();
    } finally {
        clearInterval(camera);
        await run.stop();
        file = join(folder, "sheets.json");
    }
});

test("without --web-edit-sheets, the page only shows", async () => {
    const run = await watchDrive([]);
    try {
        const { page } = await openSheets(run.url);
        await page.locator("#sheets-notice", { hasText: "--web-edit-sheets" }).waitFor();
        await select(page, "shelf");
        for (const id of ["place-x", "sheet-reprint", "place-remove", "new-name", "sheets-undo", "stitch-start"])
            assert.equal(await page.isDisabled(`#${id}`), true, id);
        const before = readFileSync(file, "utf8");
        const { at } = await mapOf(page);
        await drag(page, at(200, -50), at(230, -70));
        const sent = [
            { do: "sheet-place", name: "shelf", revision: 2, x_mm: 1, y_mm: 2, yaw_deg: 3 },
            { do: "sheet-reprint", name: "shelf" },
            { do: "sheet-print", name: "new", paper: "A4", landscape: false, spacing_mm: 0.508 },
            { do: "sheet-undo" },
            { do: "stitch-start" },
        ];
        for (const values of sent) assert.match((await command(page, values)).message, /only show/);
        assert.equal(readFileSync(file, "utf8"), before);
        await page.close();
    } finally {
        await run.stop();
    }
});

test("a run without a sheet file says so", async () => {
    const run = await watchSource([join(folder, "drive.mp4"), "--realtime", "--fps", "5"]);
    try {
        const { page } = await open(browser.context, `${run.url}#sheets`);
        await page.locator("#sheets-notice", { hasText: "no sheet file" }).waitFor();
        assert.equal(await page.isVisible("#sheets-content"), false);
        await page.close();
    } finally {
        await run.stop();
    }
});

test("axe finds no violation, and nothing is wider than the screen", async () => {
    const run = await watchDrive();
    try {
        const { page } = await openSheets(run.url);
        await requireAccessible(page);
        await select(page, "shelf");
        await requireAccessible(page);
        await page.fill("#rename-name", "door");
        await save(page, "rename");
        await message(page, /^Refused/);
        await requireAccessible(page);
        await page.click("#stitch-start");
        await page.waitForSelector("#stitch-progress", { state: "visible" });
        await requireAccessible(page);
        await page.close();
    } finally {
        await run.stop();
    }
});
