// Known places: finds the most likely place of a block on the known sheets. Also computes an upper
// bound on the probability that a place is wrong, from the odds of all places on the sheets. See
// docs/integrity.md, "Known sheets".
#pragma once

#include <optional>

#include "core/decode/bit_lines.hpp"
#include "core/known_sheets.hpp"
#include "dotpose/device_options.hpp"

namespace dotpose::core {

/// A place on a known sheet, and the orientation of the block at this place.
struct KnownPlace {
    CodeVariant code = CodeVariant::anoto;
    int quarters = 0;            ///< argument of `turned` that makes the block upright
    Place place;                 ///< place of cell (0, 0) of the turned block
    int bits = 0;                ///< number of bits in the block, two per dot
    std::array<int, 2> wrong{};  ///< numbers of wrong x bits and wrong y bits

    /// Returns true if at most max_bit_error_q8 / 256 of the bits on each axis are wrong.
    bool is_plausible(const IntegrityOptions& options) const {
        return 512 * std::max(wrong[0], wrong[1]) <= bits * options.max_bit_error_q8;
    }
};

/// Returns true if an upright block shows any part of a known sheet. Cell (0, 0) of the block is at
/// `place`.
bool shows_sheet(const KnownSheets& sheets, CodeVariant code, const Place& place,
                 const BitBlock& block);

/// Returns the place where the number of bits that agree with the code is highest, over all sheets,
/// codes and orientations. Returns nullopt if the block has no bits. `sheets` must contain at least
/// one region.
std::optional<KnownPlace> find_known_place(const Kernels& kernels, const BitBlock& block,
                                           const KnownSheets& sheets);

/// Returns an upper bound on the probability that `place` is wrong. The true place may be elsewhere
/// on the sheets, or no known sheet may be in view. `place` is the place of cell (0, 0) in the
/// upright block. `bits_per_error` is IntegrityOptions::bits_per_error. Returns 1 if `place` is not
/// on the sheets, or if the bits contain no information.
float known_place_wrong(const Kernels& kernels, const BitBlock& block, const KnownSheets& sheets,
                        CodeVariant code, const Place& place, int bits_per_error = 0);

}  // namespace dotpose::core
