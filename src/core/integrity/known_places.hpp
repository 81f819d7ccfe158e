// Known places: the likeliest place of a block of bits on the known sheets, and the probability
// that a place is wrong, computed from the odds of all places on the sheets. docs/integrity.md
// derives the sums.
#pragma once

#include <optional>

#include "core/decode/bit_lines.hpp"
#include "core/known_sheets.hpp"
#include "dotpose/device_options.hpp"

namespace dotpose::core {

/// A place on a known sheet, and the orientation of the block at this place.
struct KnownPlace {
    CodeVariant code = CodeVariant::anoto;
    int quarters = 0;            ///< quarter turns from the block to the pattern, as for `turned`
    Place place;                 ///< place of cell (0, 0) of the turned block
    int bits = 0;                ///< number of bits of the block, two per dot
    std::array<int, 2> wrong{};  ///< number of x bits and of y bits that contradict the place

    /// Returns true if the fraction of wrong bits on each axis is at most `max_bit_error_q8` / 256.
    bool is_plausible(const IntegrityOptions& options) const {
        return 512 * std::max(wrong[0], wrong[1]) <= bits * options.max_bit_error_q8;
    }
};

/// Returns true if at least some of the bits of an upright block are on a known sheet. `place` is
/// the place of cell (0, 0) of the block.
bool shows_sheet(const KnownSheets& sheets, CodeVariant code, const Place& place,
                 const BitBlock& block);

/// Returns the place on the sheets, in any code and any orientation of the block, that agrees best
/// with the bits of the block. Returns nullopt if the block has no bits. `sheets` must contain at
/// least one region.
std::optional<KnownPlace> find_known_place(const Kernels& kernels, const BitBlock& block,
                                           const KnownSheets& sheets);

/// Returns an upper bound on the probability that `place` is wrong: cell (0, 0) of the upright
/// block is at another place on the sheets, or the view shows none of the sheets. Returns 1 if
/// `place` is not on the sheets, or if the bits carry no information.
float known_place_wrong(const Kernels& kernels, const BitBlock& block, const KnownSheets& sheets,
                        CodeVariant code, const Place& place);

}  // namespace dotpose::core
