// Accessibility checks for the pages.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const kAxe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** Requires that axe finds no violations, and that nothing is wider than the screen. */
export async function audit(page) {
    // Evaluates axe from the test, because the page's content security policy does not apply to scripts that the test
    // runs.
    await page.evaluate(kAxe);
    const { violations } = await page.evaluate(() => globalThis.axe.run());
    assert.deepEqual(violations.map(({ id, nodes }) => [id, nodes[0].html]), []);
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= page.viewportSize().width);
}

/** Audits the page in both colour schemes, at desktop and phone sizes. */
export async function requireAccessible(page) {
    const size = page.viewportSize();
    for (const colorScheme of ["dark", "light"]) {
        for (const width of [1200, 390, 320]) {
            await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
            await page.setViewportSize({ width, height: 800 });
            await audit(page);
        }
    }
    await page.setViewportSize(size);
}
