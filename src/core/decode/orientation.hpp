// Orientation: which of the four quarter turns stands the grid upright on the pattern. Paper
// section II-B.6.
#pragma once

#include <array>

#include "dotpose/status.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

/// The four turns, the likeliest first: columns and rows each vote on whether they agree better
/// with the main sequence as they are, or flipped and reversed.
std::array<Turn, 4> rank_turns(const Grid& grid, const Region& region);

/// Whether the region agrees with the mirrored pattern, whose columns carry the bits of rows, much
/// better than with the pattern itself.
bool is_mirrored(const Grid& grid, const Region& region);

}  // namespace dotpose::core
