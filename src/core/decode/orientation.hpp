// Orientation: which of the four quarter turns stands the grid upright on the pattern. Paper
// section II-B.6.
#pragma once

#include <array>

#include "core/stages.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

struct Orientation {
    std::array<Turn, 4> turns;  ///< the likeliest first
    std::int32_t agreement;  ///< of the voting lines with the main sequence, at the likeliest turn
};

/// Ranks the four turns. Columns and rows vote on whether they agree better with the main sequence
/// as they are, or flipped and reversed.
Orientation rank_turns(const Grid& grid, const Region& region);

/// Returns whether the region agrees much better with the mirrored pattern, whose columns carry the
/// bits of rows, than with the pattern itself. `agreement` is that with the pattern, from
/// `rank_turns`.
bool is_mirrored(const Grid& grid, const Region& region, std::int32_t agreement);

}  // namespace dotpose::core
