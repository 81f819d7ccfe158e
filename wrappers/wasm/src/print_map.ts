// Print maps, applied by the functions in wrappers/c/space/dotpose_print_map.h.
import { callOk, callSpace } from "./core.js";
import type { Instance } from "./instance.js";
import { kMapUses, type MapUse } from "./names.js";

const kPointerBytes = 4;
const kUseBytes = 4;

/** A print map in the memory of an instance. */
export class PrintMap {
    readonly #core: Instance;
    readonly #use: number;
    /** Address of the dotpose_print_map. */
    readonly address: number;

    /** Throws RangeError, with the reason, if the bytes are not a print map. */
    constructor(core: Instance, bytes: Uint8Array) {
        this.#core = core;
        this.#use = core.reserve(kUseBytes);
        const copy = core.reserve(bytes.length);
        if (copy === 0) throw new RangeError("the print map does not fit into the memory");
        core.bytes(copy, bytes.length).set(bytes);
        const pointer = core.reserve(kPointerBytes);
        const status = callSpace(core, "dotpose_print_map_create", copy, bytes.length, pointer);
        if (status !== 0) throw new RangeError("the print map does not fit into the memory");
        core.call("free", copy);
        this.address = core.view(pointer, kPointerBytes).getUint32(0, true);
    }

    /** Replaces the fix of the newest image with the corrected fix, if the map can be used. */
    correct(locator: number, fix: number): MapUse {
        callOk(this.#core, "dotpose_print_map_correct", this.address, locator, fix, this.#use);
        return kMapUses[this.#core.view(this.#use, kUseBytes).getInt32(0, true)]!;
    }
}
