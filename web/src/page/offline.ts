// The service worker, which keeps the page for when there is no network.
import { show } from "./dom.js";

export function startOffline(): void {
    if (!("serviceWorker" in navigator) || import.meta.env.DEV) return;
    navigator.serviceWorker
        .register("./service_worker.js", { type: "module" })
        .then(() => navigator.serviceWorker.ready)
        .then(() => show({ "offline-state": "The page also works offline." }))
        .catch(() => {
            // From a file or without permission to store; the page works all the same.
        });
}
