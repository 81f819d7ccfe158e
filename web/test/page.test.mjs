// Tests the whole page: it must be accessible, work offline, be installable, and make no requests
// to other servers.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { launch, open, serve } from "./browser.mjs";
import { makeClip } from "./clip.mjs";

const kAxe = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
let server;
let browser;

before(async () => {
    server = await serve();
    browser = await launch({ viewport: { width: 1200, height: 1000 }, bypassCSP: true });
});
after(async () => {
    await browser?.close();
    await server?.close();
});

async function complaintsOfAxe(page) {
    await page.addScriptTag({ path: kAxe });
    const { violations } = await page.evaluate(() => globalThis.axe.run());
    return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 120)).join(" | ")}`);
}

for (const view of ["try", "look", "print"]) {
    for (const colorScheme of ["light", "dark"]) {
        test(`axe finds nothing in ${view}, ${colorScheme}`, async () => {
            const { page } = await open(browser.context, `${server.url}#${view}`);
            await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
            await page.waitForTimeout(500);
            assert.deepEqual(await complaintsOfAxe(page), []);
            await page.close();
        });
    }
}

test("axe finds nothing in a frame explained, light and dark", async () => {
    const folder = mkdtempSync(join(tmpdir(), "dotpose-frame-"));
    try {
        const { page } = await open(browser.context, `${server.url}#look`);
        const [{ png: buffer }] = makeClip(folder, { frames: 1, size: "640x480" });
        await page.setInputFiles("#look-file", { name: "frame.png", mimeType: "image/png", buffer });
        await page.waitForFunction(() => document.getElementById("look-x").textContent !== "–");
        await page.click("#look-freeze");
        assert.equal(await page.locator("#explain[open] h3").count(), 6);
        for (const colorScheme of ["light", "dark"]) {
            await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
            assert.deepEqual(await complaintsOfAxe(page), [], colorScheme);
        }
        await page.close();
    } finally {
        rmSync(folder, { recursive: true });
    }
});

test("on a phone nothing is wider than the screen", async () => {
    const page = await browser.context.newPage();
    await page.setViewportSize({ width: 320, height: 640 });
    for (const view of ["try", "look", "print"]) {
        await page.goto(`${server.url}#${view}`);
        await page.waitForTimeout(300);
        assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 320, view);
    }
    await page.close();
});

test("all can be reached by the keyboard alone", async () => {
    const { page } = await open(browser.context, server.url);
    await page.keyboard.press("Tab");
    assert.equal(await page.evaluate(() => document.activeElement.className), "skip");
    const reached = new Set();
    for (let i = 0; i < 30; ++i) {
        await page.keyboard.press("Tab");
        reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.dataset.view));
    }
    for (const wanted of ["look", "print", "try-camera", "try-drive", "try-blur_px", "try-size"])
        assert.ok(reached.has(wanted), `${wanted} is not reached by Tab`);
    await page.close();
});

test("it works offline after a visit, printing too", async () => {
    const { page } = await open(browser.context, server.url);
    await page.waitForFunction(() => document.getElementById("offline-state").textContent !== "");
    await browser.context.setOffline(true);
    try {
        await server.close();
        await page.reload();
        await page.waitForFunction(() => document.getElementById("try-x").textContent !== "–");
        await page.click("nav [data-view=print]");
        const [file] = await Promise.all([page.waitForEvent("download"), page.click("#print-form [type=submit]")]);
        assert.match(file.suggestedFilename(), /\.pdf$/);
    } finally {
        await browser.context.setOffline(false);
        await page.close();
        server = await serve();
    }
});

test("browsers offer to install it", async () => {
    const { page } = await open(browser.context, server.url);
    await page.waitForFunction(() => document.getElementById("offline-state").textContent !== "");
    const session = await browser.context.newCDPSession(page);
    const { installabilityErrors } = await session.send("Page.getInstallabilityErrors");
    assert.deepEqual(installabilityErrors.map(({ errorId }) => errorId).filter((id) => id !== "in-incognito"), []);
    const manifest = await page.evaluate(() => fetch("./manifest.webmanifest").then((response) => response.json()));
    for (const { src, sizes, type } of manifest.icons) {
        const size = await page.evaluate(async (url) => {
            const image = new Image();
            image.src = url;
            await image.decode();
            return [image.naturalWidth, image.naturalHeight];
        }, src);
        if (type === "image/png") assert.equal(size.join("x"), sizes, src);
    }
    await page.close();
});
