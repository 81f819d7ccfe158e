// Tests the "Try" view: the simulated camera must be located after the user has moved it, and after its frames have
// been degraded.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, open, serve } from "./browser.mjs";

let server;
let browser;

before(async () => {
    server = await serve();
    // If reduced motion is preferred, the camera does not drive automatically.
    browser = await launch({ viewport: { width: 1200, height: 1000 }, reducedMotion: "reduce" });
});
after(async () => {
    await browser?.close();
    await server?.close();
});

async function openTry() {
    const opened = await open(browser.context, server.url);
    await opened.page.waitForFunction(() => document.getElementById("try-x").textContent !== "–");
    return opened;
}

/** Returns the position and the error shown on the page, in mm. */
async function shown(page) {
    const [x, y, error] = await Promise.all(["#try-x", "#try-y", "#try-error"].map((id) => page.textContent(id)));
    const unit_mm = { µm: 0.001, mm: 1 }[error.split(" ")[1]];
    return { x_mm: parseFloat(x), y_mm: parseFloat(y), error_mm: parseFloat(error) * unit_mm };
}

/** Applies a change and waits until the page has drawn the result. */
async function settled(page, change) {
    await change();
    await page.waitForFunction(() => document.getElementById("try-camera").dataset.busy === "false");
}

test("the first frame is read at the middle of the sheet, without a word of complaint", async () => {
    const { page, complaints } = await openTry();
    const { x_mm, y_mm, error_mm } = await shown(page);
    assert.ok(Math.hypot(x_mm - 105, y_mm - 148) < 0.004, `${x_mm}, ${y_mm}`);
    assert.ok(error_mm < 0.004, `${error_mm} mm off`);
    assert.match(await page.textContent("#try-wrong"), /1 in/);
    assert.deepEqual(complaints, []);
    await page.close();
});

test("the picture follows the mouse", async () => {
    const { page } = await openTry();
    await settled(page, () => page.fill("#try-turn_deg", "0"));
    const box = await page.locator("#try-camera").boundingBox();
    const start = await shown(page);
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await settled(page, () => page.mouse.move(box.x + box.width / 4, box.y + box.height / 2, { steps: 4 }));
    await page.mouse.up();
    const { x_mm, y_mm, error_mm } = await shown(page);
    // The picture is 188 px wide and was dragged by a quarter of its width. Each pixel covers 0.046 mm of the paper.
    assert.ok(Math.abs(x_mm - start.x_mm - (188 * 0.046) / 4) < 0.05, `${start.x_mm} to ${x_mm}`);
    assert.ok(Math.abs(y_mm - start.y_mm) < 0.01);
    assert.ok(error_mm < 0.004);
    await page.close();
});

test("keys move and turn it", async () => {
    const { page } = await openTry();
    await page.focus("#try-camera");
    await settled(page, () => page.keyboard.press("Shift+ArrowRight"));
    const moved = await shown(page);
    assert.ok(Math.hypot(moved.x_mm - 105, moved.y_mm - 148) > 1);
    await settled(page, () => page.keyboard.press("e"));
    assert.equal(await page.textContent("#try-angle").then((text) => Math.round(parseFloat(text))), 25);
    await page.close();
});

test("a click on the map moves the camera there", async () => {
    const { page } = await openTry();
    const box = await page.locator("#try-map").boundingBox();
    await settled(page, () => page.mouse.click(box.x + box.width / 2, box.y + box.height / 4));
    const { x_mm, y_mm, error_mm } = await shown(page);
    assert.ok(Math.abs(x_mm - 105) < 1 && y_mm > 55 && y_mm < 90, `${x_mm}, ${y_mm}`);
    assert.ok(error_mm < 0.004);
    await page.close();
});

test("a frame that cannot be located gets a hint and no pose", async () => {
    const { page } = await openTry();
    await page.fill("#try-paper_level", "5");
    await page.waitForFunction(() => document.getElementById("try-hint").textContent.startsWith("Brighter"));
    await page.click("[data-preset=usual]");
    await page.waitForFunction(() => document.getElementById("try-x").textContent !== "–");
    await page.fill("#try-blur_px", "3.5");
    await page.waitForFunction(() => document.getElementById("try-hint").textContent !== "");
    assert.equal(await page.textContent("#try-error"), "–");
    await page.close();
});

test("the presets are located; hard ones less exactly than clean ones", async () => {
    const { page } = await openTry();
    for (const [preset, max_mm] of [["clean", 0.003], ["usual", 0.004], ["hard", 0.02]]) {
        await settled(page, () => page.click(`[data-preset=${preset}]`));
        const { error_mm } = await shown(page);
        assert.ok(error_mm < max_mm, `${preset}: ${error_mm} mm off`);
    }
    await page.click("[data-preset=usual]");
    await settled(page, () => page.selectOption("#try-size", "640x480"));
    assert.ok((await shown(page)).error_mm < 0.004);
    const { width, height } = await page.locator("#try-camera").boundingBox();
    assert.ok(Math.abs(width / height - 640 / 480) < 0.01, `${width} x ${height}`);
    await page.close();
});

test("a small view is located only if its sheet is known", async () => {
    const { page } = await openTry();
    await settled(page, () => page.selectOption("#try-size", "66x66"));
    await settled(page, () => page.selectOption("#try-known", "none"));
    assert.equal(await page.textContent("#try-x"), "–");
    for (const size of ["66x66", "36x36"]) {
        await settled(page, () => page.selectOption("#try-size", size));
        await settled(page, () => page.selectOption("#try-known", "only"));
        const { x_mm, y_mm, error_mm } = await shown(page);
        assert.ok(Math.hypot(x_mm - 105, y_mm - 148) < 0.03 && error_mm < 0.03, `${size}: ${x_mm}, ${y_mm}`);
        assert.equal(await page.textContent("#try-sheet"), "A4 page");
        assert.equal(await page.textContent("#try-prior"), "only known sheets");
    }
    const { width, height } = await page.locator("#try-camera").boundingBox();
    assert.ok(Math.abs(width - height) < 1, `${width} x ${height}`);
    await page.close();
});

test("a sheet that is not known is shown with a warning", async () => {
    const { page } = await openTry();
    assert.equal(await page.textContent("#try-sheet"), "A4 page");
    assert.equal(await page.isHidden("#try-hint"), true);
    await settled(page, () => page.selectOption("#try-known", "other"));
    assert.ok((await shown(page)).error_mm < 0.004);
    assert.equal(await page.textContent("#try-sheet"), "not known");
    assert.match(await page.textContent("#try-hint"), /^Located, but on no known sheet/);
    await settled(page, () => page.selectOption("#try-known", "none"));
    assert.equal(await page.isHidden("#try-hint"), true);
    await page.close();
});

test("it drives automatically until the user moves it", async () => {
    const { page } = await openTry();
    await page.click("#try-drive");
    await page.waitForFunction(() => Math.abs(parseFloat(document.getElementById("try-x").textContent) - 105) > 0.5);
    assert.equal(await page.getAttribute("#try-drive", "aria-pressed"), "true");
    await page.focus("#try-camera");
    await page.keyboard.press("ArrowUp");
    assert.equal(await page.getAttribute("#try-drive", "aria-pressed"), "false");
    await page.close();
});
