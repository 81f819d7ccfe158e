import { createHash } from "node:crypto";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, relative } from "node:path";
import { build, defineConfig } from "vite";

function filesBelow(folder) {
    return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
        const path = join(folder, entry.name);
        return entry.isDirectory() ? filesBelow(path) : [path];
    });
}

/**
 * Returns the code of the service worker, which contains a list of all files in the build and a hash of their contents.
 */
async function serviceWorker(paths, folder) {
    const hash = createHash("sha256");
    for (const path of paths) hash.update(path).update(readFileSync(path));
    const files = ["./", ...paths.map((path) => `./${relative(folder, path)}`)];
    const [{ output }] = await build({
        configFile: false,
        logLevel: "warn",
        publicDir: false,
        define: {
            __FILES__: JSON.stringify(files),
            __BUILD__: JSON.stringify(hash.digest("hex").slice(0, 12)),
        },
        build: {
            write: false,
            lib: { entry: "src/service_worker.ts", formats: ["es"], fileName: "service_worker" },
        },
    });
    return output[0].code;
}

/** Adds the service worker to the build, after all other files. */
function offline() {
    let folder = "";
    return {
        name: "dotpose-offline",
        apply: "build",
        configResolved: (config) => {
            folder = config.build.outDir;
        },
        closeBundle: async () => {
            const path = join(folder, "service_worker.js");
            const others = filesBelow(folder).filter((other) => other !== path).sort();
            writeFileSync(path, await serviceWorker(others, folder));
        },
    };
}

export default defineConfig({
    // Makes all addresses relative, so the page works in any folder on a server.
    base: "./",
    build: { target: "es2022", assetsInlineLimit: 0 },
    worker: { format: "es" },
    optimizeDeps: { exclude: ["dotpose"] },
    plugins: [offline()],
});
