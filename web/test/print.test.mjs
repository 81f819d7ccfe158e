// Tests the "Print" view: the rendered PDF must show the same dots as the PDF from the command-line tool.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { dotpose, launch, open, serve } from "./browser.mjs";

let folder;
let server;
let browser;

before(async () => {
    folder = mkdtempSync(join(tmpdir(), "dotpose-print-"));
    server = await serve();
    browser = await launch({ viewport: { width: 1200, height: 1000 } });
});
after(async () => {
    await browser?.close();
    await server?.close();
    if (folder) rmSync(folder, { recursive: true, force: true });
});

/** Renders the first page in greyscale. */
function render(pdf, dpi) {
    const out = pdf.replace(/\.pdf$/, "");
    execFileSync("pdftoppm", ["-r", String(dpi), "-gray", "-singlefile", pdf, out]);
    const bytes = readFileSync(`${out}.pgm`);
    const [, width, height] = /^P5\s+(\d+)\s+(\d+)\s+255\s/.exec(bytes.subarray(0, 64).toString("latin1")).map(Number);
    return { path: `${out}.pgm`, width, height, pixels: bytes.subarray(bytes.length - width * height) };
}

async function printed({ paper, x, y, code = "anoto", margin = "6", name = "test" }) {
    const { page, complaints } = await open(browser.context, `${server.url}#print`);
    await page.selectOption("#print-paper", paper);
    await page.selectOption("#print-code", code);
    for (const [id, value] of [["name", name], ["margin", margin], ["x", x], ["y", y]])
        await page.fill(`#print-${id}`, value);
    const [file] = await Promise.all([page.waitForEvent("download"), page.click("#print-form [type=submit]")]);
    const path = join(folder, `${name}.pdf`);
    await file.saveAs(path);
    return { page, complaints, path, suggested: file.suggestedFilename() };
}

/** Counts the pixels that differ between the images, and the dark pixels of `a`. Ignores the margins. */
function differences(a, b, margin_px) {
    assert.deepEqual([a.width, a.height], [b.width, b.height]);
    let [different, dark] = [0, 0];
    for (let v = margin_px; v < a.height - margin_px; ++v)
        for (let u = margin_px; u < a.width - margin_px; ++u) {
            const at = v * a.width + u;
            if (a.pixels[at] !== b.pixels[at]) ++different;
            if (a.pixels[at] < 128) ++dark;
        }
    return { different, dark };
}

for (const code of ["anoto", "libdots"]) {
    test(`a sheet of ${code} has pixel by pixel the dots of the tool's`, async () => {
        const { page, complaints, path, suggested } = await printed({ paper: "105x148", x: "123456", y: "7890", code, name: `page ${code}` });
        assert.equal(suggested, `page-${code}.pdf`);
        assert.deepEqual(complaints, []);
        const theirs = join(folder, `tool-${code}.pdf`);
        dotpose("print", "-o", theirs, "--paper", "A6", "--margin", "6", "--origin", "123456,7890", "--code", code);
        for (const dpi of [300, 600]) {
            const { different, dark } = differences(render(path, dpi), render(theirs, dpi), Math.ceil((6 * dpi) / 25.4));
            assert.ok(dark > 10_000, `${dark} dark pixels`);
            assert.equal(different, 0, `${different} pixels differ at ${dpi} dpi`);
        }
        await page.close();
    });
}

test("what is printed passes check-print and is located where it should be", async () => {
    const { page, path } = await printed({ paper: "148x210", x: "410815000", y: "2000", name: "a5" });
    const rendered = render(path, 600);
    // Throws if the check finds faults, because the exit status is then nonzero.
    const verdict = dotpose("check-print", rendered.path, "--dpi", "600");
    assert.match(verdict, /\b600\b|100(\.0+)? ?%|ok/i);
    const fix = JSON.parse(dotpose("locate", "--code", "anoto", rendered.path));
    assert.equal(fix.status, "ok");
    // The expected x is that of the page centre, in pattern coordinates.
    const origin_mm = JSON.parse(await page.evaluate(() => localStorage.getItem("dotpose-sheets"))).at(-1).layout;
    const expected_mm = 410815000 * 0.508 + 148 / 2 - origin_mm.first_x_mm;
    assert.ok(Math.abs(fix.x_mm - expected_mm) < 0.03, `${fix.x_mm}, not ${expected_mm}`);
    const text = execFileSync("pdftotext", [path, "-"], { encoding: "utf8" });
    assert.match(text, /a5, cells 410815000,2000 to .* print at 100 %/);
    await page.close();
});

test("the sheets that were printed are known, and can be forgotten", async () => {
    const { page } = await printed({ paper: "105x148", x: "5000", y: "6000", name: "forgettable" });
    await page.reload();
    await page.waitForSelector("#print-list li:has-text('forgettable')");
    assert.equal(await page.inputValue("#print-x").then(Number) > 5000, true, "a fresh sheet begins beyond the known ones");
    await page.click("[aria-label='Forget the sheet forgettable']");
    assert.equal(await page.locator("#print-list li:has-text('forgettable')").count(), 0);
    await page.close();
});

test("a sheet that cannot be is refused with its reason", async () => {
    const { page } = await open(browser.context, `${server.url}#print`);
    await page.fill("#print-x", "410815347");
    await page.waitForFunction(() => document.getElementById("print-status").textContent.startsWith("This sheet cannot"));
    assert.match(await page.textContent("#print-status"), /column|plane/);
    await page.close();
});
