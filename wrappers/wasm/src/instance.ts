// Compiles and starts the modules. The modules have no imports, so an instance consists of a memory
// and functions.

/** Source of a module: the URL of the `.wasm` file, its bytes, or the compiled module. */
export type WasmSource = string | URL | BufferSource | WebAssembly.Module;

/**
 * A module whose only function creates a vector. Engines without vector instructions reject the
 * module.
 */
const kSimdProbe = new Uint8Array([
    ...[0x00, 0x61, 0x73, 0x6d, 0x01, 0x00, 0x00, 0x00], // "\0asm", version 1
    ...[0x01, 0x05, 0x01, 0x60, 0x00, 0x01, 0x7b], // types: () -> v128
    ...[0x03, 0x02, 0x01, 0x00], // functions: one function of this type
    ...[0x0a, 0x08, 0x01, 0x06, 0x00, 0x41, 0x00, 0xfd, 0x0f, 0x0b], // code: i8x16.splat of 0
]);

/** Returns true if the engine supports the vector instructions of `dotpose-simd.wasm`. */
export function hasSimd(): boolean {
    return WebAssembly.validate(kSimdProbe);
}

/** Compiled modules by URL. Each module is compiled only once. */
const compiled = new Map<string, Promise<WebAssembly.Module>>();

/** Returns the compiled module for a source. */
export function compile(source: WasmSource): Promise<WebAssembly.Module> {
    if (source instanceof WebAssembly.Module) return Promise.resolve(source);
    if (typeof source !== "string" && !(source instanceof URL)) return WebAssembly.compile(source);
    const url = String(source);
    let module = compiled.get(url);
    if (module === undefined) {
        module = bytesOf(url).then((bytes) => WebAssembly.compile(bytes));
        module.catch(() => compiled.delete(url)); // allows the next call to try again
        compiled.set(url, module);
    }
    return module;
}

async function bytesOf(url: string): Promise<BufferSource> {
    if (url.startsWith("file:")) {
        // In Node, fetch cannot read files. The module name is a variable, so bundlers do not
        // resolve it.
        const name = "node:fs/promises";
        const files = (await import(/* @vite-ignore */ /* webpackIgnore: true */ name)) as {
            readFile(url: URL): Promise<Uint8Array<ArrayBuffer>>;
        };
        return files.readFile(new URL(url));
    }
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
    return response.arrayBuffer();
}

/** An instance of a module. */
export class Instance {
    readonly #functions: Record<string, (...args: (number | bigint)[]) => number>;
    readonly #memory: WebAssembly.Memory;
    #used_bytes: number;

    private constructor(exported: WebAssembly.Exports) {
        this.#functions = exported as Record<string, (...args: (number | bigint)[]) => number>;
        this.#memory = exported["memory"] as WebAssembly.Memory;
        this.#used_bytes = (exported["__heap_base"] as WebAssembly.Global | undefined)?.value ?? 0;
        this.#functions["_initialize"]?.();
    }

    /** Starts a module asynchronously. Browsers require this for large modules. */
    static async start(module: WebAssembly.Module): Promise<Instance> {
        return new Instance((await WebAssembly.instantiate(module, {})).exports);
    }

    /** Starts a module synchronously. */
    static startNow(module: WebAssembly.Module): Instance {
        return new Instance(new WebAssembly.Instance(module, {}).exports);
    }

    /** Calls a function of the module with numbers or addresses as arguments. */
    call(name: string, ...args: (number | bigint)[]): number {
        return this.#functions[name]!(...args);
    }

    /**
     * Reserves memory and returns its address. A module that allocates memory must export
     * `aligned_alloc`.
     */
    reserve(bytes: number): number {
        const kAlignment = 64;
        const allocate = this.#functions["aligned_alloc"];
        if (allocate !== undefined) return allocate(kAlignment, Math.ceil(bytes / kAlignment) * kAlignment);
        const kPage = 65536;
        const address = Math.ceil(this.#used_bytes / kAlignment) * kAlignment;
        this.#used_bytes = address + bytes;
        const missing = this.#used_bytes - this.#memory.buffer.byteLength;
        if (missing > 0) this.#memory.grow(Math.ceil(missing / kPage));
        return address;
    }

    /**
     * Returns a view of the memory. The view is valid only until the memory grows, so it must not
     * be stored.
     */
    bytes(address: number, length: number): Uint8Array<ArrayBuffer> {
        return new Uint8Array(this.#memory.buffer as ArrayBuffer, address, length);
    }
    /** Returns a view of the memory for reading numbers. */
    view(address: number, length: number): DataView<ArrayBuffer> {
        return new DataView(this.#memory.buffer as ArrayBuffer, address, length);
    }

    /** Returns the C string at an address. */
    text(address: number): string {
        const rest = new Uint8Array(this.#memory.buffer, address);
        return new TextDecoder().decode(rest.slice(0, rest.indexOf(0)));
    }
}
