// Redraws the icons in public/icons/. Run with `node tools/draw_icons.mjs`. Renders the PNG files
// with Chromium.
import { writeFile, mkdir } from "node:fs/promises";
import { chromium } from "playwright-core";

const kFolder = new URL("../public/icons/", import.meta.url);
/** Five rows of symbols. The letters u, d, l and r are the displacement directions of the dots. */
const kRows = ["rulud", "udrlu", "lrudr", "durlu", "ldurl"];
const kStep = { u: [0, -1], d: [0, 1], l: [-1, 0], r: [1, 0] };

/**
 * Returns an icon as SVG. `inset` keeps the drawing inside the circle to which phones may crop the
 * icon.
 */
function icon({ radius, inset }) {
    const cell = (512 - 2 * inset) / 5;
    const at = (i) => inset + (i + 0.5) * cell;
    const lines = [0, 1, 2, 3, 4].map(
        (i) => `<path d="M${inset} ${at(i)}H${512 - inset}M${at(i)} ${inset}V${512 - inset}"/>`,
    );
    const dots = kRows.flatMap((row, j) =>
        [...row].map((symbol, i) => {
            const [dx, dy] = kStep[symbol].map((d) => d * cell * 0.2);
            const ink = i === 2 && j === 2 ? "#ffb000" : "#ffffff";
            return `<circle cx="${at(i) + dx}" cy="${at(j) + dy}" r="${cell * 0.2}" fill="${ink}"/>`;
        }),
    );
    return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 512 512">
<rect width="512" height="512" rx="${radius}" fill="#1f5fae"/>
<g stroke="#ffffff" stroke-opacity="0.28" stroke-width="5">
${lines.join("\n")}
</g>
${dots.join("\n")}
</svg>
`;
}

await mkdir(kFolder, { recursive: true });
const round = icon({ radius: 112, inset: 44 });
await writeFile(new URL("icon.svg", kFolder), round);
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
const page = await browser.newPage();
for (const [name, size, svg] of [
    ["icon-192.png", 192, round],
    ["icon-512.png", 512, round],
    ["maskable-512.png", 512, icon({ radius: 0, inset: 110 })],
]) {
    await page.setViewportSize({ width: size, height: size });
    await page.setContent(`<style>body{margin:0}svg{display:block;width:${size}px}</style>${svg}`);
    await page.screenshot({ path: new URL(name, kFolder).pathname, omitBackground: true });
}
await browser.close();
