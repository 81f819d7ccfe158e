// Keeps all files of this build, and answers with them, so that the page works offline. vite.config.js
// puts in the list.
declare const __FILES__: string[];
declare const __BUILD__: string;

/** What is used of a ServiceWorkerGlobalScope, whose types exclude those of a page. */
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
    // Past the browser's own cache, which may still have files of the build before.
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
