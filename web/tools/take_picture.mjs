// Takes the picture of the page in web/README.md. Run `node tools/take_picture.mjs` after
// web/build.
import { fileURLToPath } from "node:url";
import { launch, open, serve } from "../test/browser.mjs";

const server = await serve();
const browser = await launch({ viewport: { width: 1200, height: 1000 }, reducedMotion: "reduce" });
try {
    const { page } = await open(browser.context, server.url);
    await page.waitForFunction(() => document.getElementById("try-x").textContent !== "–");
    await page.click("#try-drive");
    // Waits until the path is visible and the JavaScript engine has optimised the code.
    await page.waitForTimeout(8000);
    const path = fileURLToPath(new URL("../../docs/pictures/page.png", import.meta.url));
    await page.screenshot({ path, fullPage: true });
} finally {
    await browser.close();
    await server.close();
}
