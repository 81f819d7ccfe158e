// Loads the core module in the variant that the engine supports.
import { compile, hasSimd, type WasmSource } from "./instance.js";

/** Returns the given module or, by default, the module in the file beside this one. */
export function coreModule(wasm?: WasmSource): Promise<WebAssembly.Module> {
    if (wasm !== undefined) return compile(wasm);
    return compile(
        hasSimd()
            ? new URL("./dotpose-simd.wasm", import.meta.url)
            : new URL("./dotpose-scalar.wasm", import.meta.url),
    );
}
