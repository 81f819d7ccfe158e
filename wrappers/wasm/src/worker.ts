// Code that runs in the worker of a WorkerLocator.
import { Locator, type FrameOptions, type Image, type LocatorOptions } from "./locator.js";

/** A request from a WorkerLocator. The answer has the same `id`. */
export type Request = { id: number } & (
    | { kind: "create"; options: LocatorOptions }
    | { kind: "locate"; image: Image; options: FrameOptions }
);

/**
 * The members of a worker's global scope that this file uses. TypeScript's DOM library (lib.dom)
 * does not declare them.
 */
interface Scope {
    onmessage: ((event: MessageEvent<Request>) => void) | null;
    postMessage(message: unknown, transfer: Transferable[]): void;
}
const scope = globalThis as unknown as Scope;

let locator: Locator | undefined;

scope.onmessage = async ({ data: request }) => {
    const { id } = request;
    try {
        if (request.kind === "create") {
            locator = await Locator.create(request.options);
            scope.postMessage({ id }, []);
            return;
        }
        const { image } = request;
        const fix = locator!.locate(image, request.options);
        scope.postMessage({ id, result: { fix, image } }, [image.data.buffer, fix.bytes.buffer]);
    } catch (error) {
        scope.postMessage({ id, error }, []);
    }
};
