// Caches all files of this build for offline use. vite.config.js inserts the list of files.
declare const __FILES__: string[];
declare const __BUILD__: string;

/**
 * The parts of ServiceWorkerGlobalScope that are used in this file. They are declared here because the TypeScript types
 * of ServiceWorkerGlobalScope conflict with the types of a page.
 */
interface WorkEvent extends Event {
    waitUntil(work: Promise<unknown>): void;
}
interface AnswerableEvent extends WorkEvent {
    readonly request: Request;
    respondWith(response: Promise<Response>): void;
}
interface Scope {
    readonly location: Location;
    readonly clients: { claim(): Promise<void> };
    skipWaiting(): Promise<void>;
    addEventListener(type: "install" | "activate", listener: (event: WorkEvent) => void): void;
    addEventListener(type: "fetch", listener: (event: AnswerableEvent) => void): void;
}
const worker = self as unknown as Scope;

const kPrefix = "dotpose-page-";
const kCache = kPrefix + __BUILD__;

async function install(): Promise<void> {
    const cache = await caches.open(kCache);
    // Bypasses the browser's HTTP cache, which may contain files from the previous build.
    await cache.addAll(__FILES__.map((file) => new Request(file, { cache: "reload" })));
    await worker.skipWaiting();
}

async function takeOver(): Promise<void> {
    const old = (await caches.keys()).filter((name) => name.startsWith(kPrefix) && name !== kCache);
    await Promise.all(old.map((name) => caches.delete(name)));
    await worker.clients.claim();
}

async function answer(request: Request): Promise<Response> {
    const cache = await caches.open(kCache);
    return (await cache.match(request, { ignoreSearch: true })) ?? fetch(request);
}

worker.addEventListener("install", (event) => event.waitUntil(install()));
worker.addEventListener("activate", (event) => event.waitUntil(takeOver()));
worker.addEventListener("fetch", (event) => {
    const { method, url } = event.request;
    if (method === "GET" && new URL(url).origin === worker.location.origin)
        event.respondWith(answer(event.request));
});
