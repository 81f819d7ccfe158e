// Loads the core module in the variant that the engine supports, and calls its functions.
import { compile, hasSimd, type Instance, type WasmSource } from "./instance.js";

/**
 * Compiles the given module. By default, compiles a module next to this file: the core or, if
 * `has_space` is true, the core with poses in space and print maps.
 */
export function coreModule(wasm?: WasmSource, has_space = false): Promise<WebAssembly.Module> {
    if (wasm !== undefined) return compile(wasm);
    if (has_space) return compile(new URL("./dotpose-space.wasm", import.meta.url));
    return compile(
        hasSimd()
            ? new URL("./dotpose-simd.wasm", import.meta.url)
            : new URL("./dotpose-scalar.wasm", import.meta.url),
    );
}

/**
 * Calls a function that returns a dotpose_status. If the status is nonzero (an option or argument
 * is invalid), throws RangeError with the message for the status.
 */
export function callOk(core: Instance, name: string, ...args: (number | bigint)[]): void {
    const status = core.call(name, ...args);
    if (status !== 0) throw new RangeError(core.text(core.call("dotpose_status_message", status)));
}

/**
 * Calls a function in dotpose-space.wasm. If the C++ library throws an exception, it stores the
 * message in the module and ends the instance with a trap. This function then throws RangeError
 * with the stored message.
 */
export function callSpace(core: Instance, name: string, ...args: number[]): number {
    try {
        return core.call(name, ...args);
    } catch (trap) {
        const message = core.text(core.call("dotpose_space_error"));
        throw message === "" ? trap : new RangeError(message);
    }
}
