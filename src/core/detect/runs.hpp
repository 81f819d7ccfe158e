// Runs: stretches of dark pixels in a row, with their sums. Second half of the thresholding of
// paper section II-B.1.
#pragma once

#include <span>

#include "core/stages.hpp"

namespace dotpose::core {

/// Number of pixels that are compared together. All have the same thresholds.
inline constexpr std::size_t kGroup_px = 8;
static_assert(kTileWidth_px % kGroup_px == 0);

/// Finds the runs of row `v` from left to right while `runs` has room, and returns their number. A
/// run at the right border of the image may end beyond it.
int find_runs(int v, const AdaptiveThreshold& threshold, std::span<Run> runs);

}  // namespace dotpose::core
