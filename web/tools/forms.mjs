// Takes screenshots of a page for the documentation.
import { execFileSync } from "node:child_process";
import { rmSync } from "node:fs";
import { join } from "node:path";

const kDesktop = { width: 1200, height: 900 };
const kPhone = { width: 390, height: 844 };
const kForms = [
    ["light", kDesktop, "light"],
    ["dark", kDesktop, "dark"],
    ["phone", kPhone, "light"],
    ["phone-dark", kPhone, "dark"],
];

/** Reduces a PNG file to 128 colours, which more than halves the file size. */
function reduce(from, to) {
    const palette = "[0]split[a][b];[a]palettegen=max_colors=128[p];[b][p]paletteuse=dither=none";
    execFileSync("ffmpeg", ["-loglevel", "error", "-y", "-i", from, "-filter_complex", palette, "-pred", "mixed", to]);
    rmSync(from);
}

/**
 * Takes four screenshots of a page, at desktop and phone size in the light and dark colour schemes. Writes
 * NAME-light.png, NAME-dark.png, NAME-phone.png and NAME-phone-dark.png. Calls `ready` before each screenshot to
 * prepare the page.
 */
export async function takeForms(page, folder, name, { ready = () => undefined, fullPhone = true } = {}) {
    const before = page.viewportSize();
    for (const [form, size, colorScheme] of kForms) {
        await page.setViewportSize(size);
        await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
        await page.evaluate(() => {
            document.activeElement?.blur();
            scrollTo(0, 0);
        });
        await page.waitForTimeout(1000);
        await ready();
        const raw = join(folder, `${name}-${form}-raw.png`);
        await page.screenshot({ path: raw, fullPage: size === kDesktop || fullPhone });
        reduce(raw, join(folder, `${name}-${form}.png`));
    }
    await page.emulateMedia({ colorScheme: "light", reducedMotion: "reduce" });
    await page.setViewportSize(before);
}
