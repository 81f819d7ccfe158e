// Orientation: the quarter turn that makes the grid upright on the pattern. Paper section II-B.6.
#pragma once

#include <array>

#include "core/decode/grid.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

struct Orientation {
    std::array<QuarterTurn, 4> turns;  ///< most likely turn first
    std::int32_t agreement;  ///< agreement of the voting lines with the main sequence, at the most
                             ///< likely turn
};

/// Ranks the four turns by a vote of the columns and rows. On each axis, the lines are compared
/// with the main sequence as read, and flipped and reversed.
Orientation rank_turns(const Grid& grid, const GridRegion& region);

/// Returns true if the region agrees much better with the mirrored pattern, whose columns contain
/// the bits of rows, than with the pattern. `agreement` is the agreement with the pattern, as
/// `rank_turns` returned it.
bool is_mirrored(const Grid& grid, const GridRegion& region, std::int32_t agreement);

}  // namespace dotpose::core
