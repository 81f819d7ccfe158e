// Sheet search: finds the place of a block of bits on the known sheets, without a table of all
// places.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "device/hard_block.hpp"
#include "dotpose/known_region.hpp"

namespace dotpose::core {

struct SheetPlace {
    int quarters = 0;            ///< quarter turns from the block to the pattern
    Place corner;                ///< place where the first column and the first row cross
    std::array<int, 2> wrong{};  ///< numbers of x bits and of y bits that contradict the place
};

/// Finds the place and the orientation of the block on the regions of `code`. Tries a few pairs of
/// adjacent lines, one after another, and tests only places at which all bits of a pair agree with
/// the code. Of the places that at most `max_wrong` bits of both axes together contradict, returns
/// the one with the fewest such bits for the first pair that has any. Returns nullopt if no pair
/// has such a place. Ignores regions in other codes.
std::optional<SheetPlace> find_on_sheets(const HardBlock& block, CodeVariant code,
                                         std::span<const KnownRegion> regions, int max_wrong);

}  // namespace dotpose::core
