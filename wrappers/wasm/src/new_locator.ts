// Sets up a locator in the memory of the core module.
import { callOk } from "./core.js";
import type { Instance } from "./instance.js";
import type { LocatorOptions } from "./locator.js";
import { codeNumber } from "./names.js";

/** Size of a dotpose_options (wrappers/c/dotpose.h), and offsets of its members. */
const kOptionsBytes = 96;
const kOptionOffsets = { code: 4, effort: 8, show_stages: 88, bits_per_error: 92 };
const kDoubleOffsets = { spacing_mm: 16, lens_k_per_px2: 24, max_p_wrong: 64 };
const kLensCentreOffset = 32;
const kPointerBytes = 4;
const kDetectCode = -1;
const kMeasuredErrorRate = -1;

/** Sets up a locator and returns its address. Throws RangeError for invalid options. */
export function newLocator(core: Instance, options: LocatorOptions): number {
    const { attempts = 2, bits_per_error = 0, code = "auto" } = options;
    if (attempts !== 1 && attempts !== 2) throw new RangeError(`attempts are 1 or 2, not ${String(attempts)}`);
    const isValid =
        typeof bits_per_error === "number"
            ? Number.isInteger(bits_per_error) && bits_per_error >= 0 && bits_per_error <= 65536
            : bits_per_error === "measured";
    if (!isValid) {
        throw new RangeError(
            `bits_per_error is "measured" or an integer from 0 to 65536, not ${String(bits_per_error)}`,
        );
    }
    const given = core.reserve(kOptionsBytes);
    callOk(core, "dotpose_options_init", given, kOptionsBytes);
    const view = core.view(given, kOptionsBytes);
    const set = (name: keyof typeof kOptionOffsets, value: number) =>
        view.setInt32(kOptionOffsets[name], value, true);
    set("code", code === "auto" ? kDetectCode : codeNumber(code));
    set("show_stages", options.dots || options.space || options.print_map ? 1 : 0);
    set("effort", attempts);
    set("bits_per_error", bits_per_error === "measured" ? kMeasuredErrorRate : bits_per_error);
    for (const name of Object.keys(kDoubleOffsets) as (keyof typeof kDoubleOffsets)[]) {
        const value = options[name];
        if (value !== undefined) view.setFloat64(kDoubleOffsets[name], value, true);
    }
    options.lens_centre_offset_px?.forEach((px, axis) => view.setFloat64(kLensCentreOffset + 8 * axis, px, true));
    const bytes = core.call("dotpose_large_bytes");
    const memory = core.reserve(bytes);
    const pointer = core.reserve(kPointerBytes);
    callOk(core, "dotpose_large_init", memory, bytes, given, pointer);
    return core.view(pointer, kPointerBytes).getUint32(0, true);
}
