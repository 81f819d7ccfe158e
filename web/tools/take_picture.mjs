// Takes the screenshots of the page for web/README.md. Run `node tools/take_picture.mjs` after running web/build. Needs
// ffmpeg.
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { launch, open, serve } from "../test/browser.mjs";
import { makeClip } from "../test/clip.mjs";
import { takeForms } from "./forms.mjs";

const kPictures = fileURLToPath(new URL("../../docs/pictures/", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "dotpose-pictures-"));
// A tilted camera 30 mm above a sheet. Its images are 640 x 480 px in size. Each pixel covers 0.046 mm of the paper.
makeClip(folder, { frames: 1, size: "640x480", options: ["--working-distance", "30", "--tilt=12,20", "--angle", "25"] });
writeFileSync(
    join(folder, "camera.yaml"),
    `format: dotpose-camera\nversion: 1\nwidth_px: 640\nheight_px: 480\nk_per_px2: 0\ncentre_px: [319.5, 239.5]\nfocal_px: ${30 / 0.046}\n`,
);
const server = await serve();
const browser = await launch({ clip: join(folder, "clip.y4m"), viewport: { width: 1200, height: 1000 }, reducedMotion: "reduce" });

async function takeTry() {
    const { page } = await open(browser.context, server.url);
    await page.waitForFunction(() => document.getElementById("try-x").textContent !== "–");
    await page.click("#try-drive");
    // Waits until the path is visible and the JavaScript engine has optimised the code.
    await page.waitForTimeout(8000);
    await page.screenshot({ path: join(kPictures, "page.png"), fullPage: true });
    await page.close();
}

async function takeLook() {
    const { page } = await open(browser.context, `${server.url}#look`);
    await page.setInputFiles("#look-camera-file", join(folder, "camera.yaml"));
    await page.click("#look-start");
    await page.waitForFunction(() => document.getElementById("look-height").textContent !== "–");
    await takeForms(page, kPictures, "page-look");
    await page.close();
}

try {
    if (process.argv[2] !== "look") await takeTry();
    if (process.argv[2] !== "try") await takeLook();
} finally {
    await browser.close();
    await server.close();
    rmSync(folder, { recursive: true, force: true });
}
