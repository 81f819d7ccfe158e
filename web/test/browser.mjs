// Opens the built page in Chromium for the tests. Provides a server for dist/ and a browser with a
// fake camera.
import { execFileSync } from "node:child_process";
import { createServer } from "node:http";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const kRoot = fileURLToPath(new URL("../..", import.meta.url));
const kDist = fileURLToPath(new URL("../dist", import.meta.url));
const kChromium = process.env.CHROMIUM ?? "/usr/bin/chromium";
/** The command-line tool of the same checkout. It renders frames and checks prints. */
export const kTool = process.env.DOTPOSE_TOOL ?? join(kRoot, "build/release/bin/dotpose");

const kTypes = {
    ".html": "text/html",
    ".js": "text/javascript",
    ".css": "text/css",
    ".wasm": "application/wasm",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".webmanifest": "application/manifest+json",
};

/** Serves dist/ under /page/, because the page must also work in a subdirectory of a server. */
export async function serve() {
    const server = createServer((request, response) => {
        const path = normalize(decodeURIComponent(new URL(request.url, "http://localhost").pathname));
        let file = join(kDist, path.replace(/^\/page\//, ""));
        if (!path.startsWith("/page/") || path.includes("..")) file = "";
        if (file !== "" && existsSync(file) && statSync(file).isDirectory()) file = join(file, "index.html");
        if (file === "" || !existsSync(file)) {
            response.writeHead(404).end();
            return;
        }
        response.writeHead(200, { "content-type": kTypes[extname(file)] ?? "application/octet-stream" });
        response.end(readFileSync(file));
    });
    await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
    return {
        url: `http://localhost:${server.address().port}/page/`,
        close: () =>
            new Promise((resolve) => {
                server.close(resolve);
                server.closeAllConnections();
            }),
    };
}

/** Starts Chromium. `clip` is the y4m file that the fake camera plays. */
export async function launch({ clip, ...options } = {}) {
    const profile = mkdtempSync(join(tmpdir(), "dotpose-page-"));
    const quiet = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"];
    const offline = ["--disable-background-networking", "--disable-component-update", "--disable-sync"];
    const camera = ["--use-fake-ui-for-media-stream", "--use-fake-device-for-media-stream"];
    const context = await chromium.launchPersistentContext(profile, {
        executablePath: kChromium,
        headless: true,
        acceptDownloads: true,
        args: [...quiet, ...offline, ...camera, ...(clip ? [`--use-file-for-fake-video-capture=${clip}`] : [])],
        ...options,
    });
    // The timeout is long enough for a busy machine.
    context.setDefaultTimeout(120_000);
    return {
        context,
        close: async () => {
            await context.close();
            rmSync(profile, { recursive: true, force: true });
        },
    };
}

/** Opens a page and collects its errors, warnings, and requests to other servers. */
export async function open(context, url) {
    const page = await context.newPage();
    const complaints = [];
    page.on("pageerror", (error) => complaints.push(String(error)));
    page.on("console", (message) => {
        if (["error", "warning"].includes(message.type())) complaints.push(message.text());
    });
    const { host } = new URL(url);
    page.on("request", (request) => {
        const asked = new URL(request.url());
        if (asked.protocol.startsWith("http") && asked.host !== host) complaints.push(`asks ${request.url()}`);
    });
    await page.goto(url);
    return { page, complaints };
}

/** Runs the command-line tool and returns its output. */
export function dotpose(...args) {
    return execFileSync(kTool, args, { encoding: "utf8", maxBuffer: 1 << 28 });
}
