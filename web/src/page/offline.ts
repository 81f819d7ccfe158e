// Registers the service worker, which caches the page for offline use.
import { show } from "./dom.js";

export function startOffline(): void {
    if (!("serviceWorker" in navigator) || import.meta.env.DEV) return;
    navigator.serviceWorker
        .register("./service_worker.js", { type: "module" })
        .then(() => navigator.serviceWorker.ready)
        .then(() => show({ "offline-state": "The page also works offline." }))
        .catch(() => {
            // The page was opened from a file, or storage is not allowed. The page still works without the cache.
        });
}
