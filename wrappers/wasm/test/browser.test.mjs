// Tests the packed and installed package in Chromium, without a bundler. A local server serves the
// files. The environment variables are the same as in node.test.mjs.
import assert from "node:assert/strict";
import { createReadStream, mkdtempSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";
import { after, before, test } from "node:test";
import { chromium } from "playwright-core";
import { kSets } from "./golden.mjs";

const kTypes = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm" };
const kArguments = [
    ...["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"],
    ...["--disable-background-networking", "--disable-component-update", "--disable-sync"],
];

/** Folders served by the local server. */
const kFolders = {
    package: join(process.env.DOTPOSE_PACKAGE, "node_modules/dotpose"),
    golden: process.env.DOTPOSE_GOLDEN,
    test: new URL(".", import.meta.url).pathname,
};

let server;
let profile;
let browser;
let page;

before(async () => {
    server = createServer((request, response) => {
        const [, top, ...rest] = normalize(new URL(request.url, "http://localhost").pathname).split("/");
        if (!(top in kFolders)) return response.writeHead(404).end();
        const path = join(kFolders[top], ...rest);
        response.setHeader("content-type", kTypes[extname(path)] ?? "application/octet-stream");
        createReadStream(path).on("error", () => response.writeHead(404).end()).pipe(response);
    });
    await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
    profile = mkdtempSync(join(tmpdir(), "dotpose-chromium-"));
    browser = await chromium.launchPersistentContext(profile, {
        executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
        headless: true,
        args: kArguments,
    });
    page = await browser.newPage();
    await page.goto(`http://localhost:${server.address().port}/test/page.html`);
});
after(async () => {
    await browser?.close();
    server?.close();
    if (profile !== undefined) rmSync(profile, { recursive: true, force: true });
});

for (const [variant, set] of ["simd", "scalar"].flatMap((variant) => kSets.map((set) => [variant, set]))) {
    test(`golden frames, ${variant}, ${set}: the same bits as the C++ library`, async () => {
        const counts = await page.evaluate(
            async ([variant, set]) => {
                const [dotpose, { compareSet }, frames, csv] = await Promise.all([
                    import("/package/dist/index.js"),
                    import("/test/golden.mjs"),
                    fetch(`/golden/${set}.frames`).then((response) => response.arrayBuffer()),
                    fetch(`/golden/${set}.csv`).then((response) => response.text()),
                ]);
                return compareSet(dotpose, frames, csv, `/package/dist/dotpose-${variant}.wasm`);
            },
            [variant, set],
        );
        assert.deepEqual(counts.different, []);
        assert.ok(counts.lines >= 3 * 40 && counts.ok > 0.9 * counts.lines, JSON.stringify(counts));
    });
}

test("a worker locates a simulated camera and gives the buffer back", async () => {
    const seen = await page.evaluate(async () => {
        const { WorkerLocator, hasSimd } = await import("/package/dist/index.js");
        const { Tools } = await import("/package/dist/tools.js");
        const tools = await Tools.create();
        const locator = await WorkerLocator.create();
        const sent = tools.render({ pose: { x_mm: 40, y_mm: 50 } });
        const answer = locator.locate(sent);
        const left = sent.data.length;
        const { fix, image } = await answer;
        const next = tools.render({ pose: { x_mm: 40.05, y_mm: 50 } });
        const tracked = (await locator.locate(next, { prediction: fix })).fix;
        const motion = { right_mm: 0.05, sigma_mm: 0.02, sigma_rad: 0.005 };
        await locator.locate(tools.render({ pose: { x_mm: 40.1, y_mm: 50 } }), { motion });
        const further = tools.render({ pose: { x_mm: 40.15, y_mm: 50 } });
        const moved = (await locator.locate(further, { motion })).fix;
        const refusal = await locator
            .locate({ data: new Uint8Array(3), width: 188, height: 120 })
            .catch((error) => `${error}`);
        locator.close();
        const closed = await locator.locate(image).catch((error) => `${error}`);
        const wrong = await WorkerLocator.create({ code: "morse" }).catch((error) => `${error}`);
        return { simd: hasSimd(), left, back: image.data.length, fix, tracked, moved, refusal, closed, wrong };
    });
    assert.equal(seen.simd, true);
    assert.equal(seen.left, 0);
    assert.equal(seen.back, 188 * 120);
    assert.ok(Math.abs(seen.fix.x_mm - 40) < 0.003 && Math.abs(seen.fix.y_mm - 50) < 0.003);
    assert.equal(seen.tracked.attempt, "tracked");
    assert.ok(Math.abs(seen.tracked.x_mm - 40.05) < 0.003);
    // The search begins at the position predicted from the motion.
    assert.equal(seen.moved.attempt, "tracked");
    assert.ok(Math.abs(seen.moved.x_mm - 40.15) < 0.003);
    assert.match(seen.refusal, /RangeError: the image needs 22560 bytes/);
    assert.match(seen.closed, /closed/);
    assert.match(seen.wrong, /RangeError: unknown code 'morse'/);
});
