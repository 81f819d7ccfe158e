// Orientation: finds the quarter turn from the grid to the upright pattern (paper, section II-B.6).
#pragma once

#include <array>

#include "core/decode/grid.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

struct Orientation {
    std::array<QuarterTurn, 4> turns;  ///< most likely turn first
    std::int32_t agreement;            ///< total score of the voting lines at turns[0]
};

/// Ranks the four turns by a vote of columns and rows. Compares each voting line, both as read and
/// after a half turn, with the main sequence. A half turn reverses the line and flips its bits.
Orientation rank_turns(const Grid& grid, const GridRegion& region);

/// Returns true if the region seems to be mirrored: its agreement with a mirrored pattern is more
/// than `tuning::turns::kMirrored_4ths` / 4 times its agreement with the upright pattern. In a
/// mirrored pattern, columns contain y bits and rows contain x bits. `agreement` is the region's
/// `Orientation::agreement`.
bool is_mirrored(const Grid& grid, const GridRegion& region, std::int32_t agreement);

}  // namespace dotpose::core
