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
    int quarters = 0;            ///< number of quarter turns from the block to the pattern
    Place corner;                ///< place where the first column and the first row cross
    std::array<int, 2> wrong{};  ///< number of wrong x bits, and number of wrong y bits
};

/// Finds the place and the orientation of the block in the regions whose code variant is `code`.
/// Ignores other regions. Tries a few pairs of adjacent lines, one after another. For each pair,
/// tests only the places at which all bits of the pair agree with the code. Accepts a place if at
/// most `max_wrong` bits, summed over both axes, disagree with the code. Stops at the first pair
/// that has accepted places, and returns the accepted place with the fewest wrong bits. Returns
/// nullopt if no pair has an accepted place.
std::optional<SheetPlace> find_on_sheets(const HardBlock& block, CodeVariant code,
                                         std::span<const KnownRegion> regions, int max_wrong);

}  // namespace dotpose::core
