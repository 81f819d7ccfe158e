// Runs: finds sequences of dark pixels in a row, and computes sums over them. This is the second
// half of thresholding (paper, section II-B.1).
#pragma once

#include <cstdint>
#include <span>

#include "core/detect/adaptive_threshold.hpp"

namespace dotpose::core {

struct OpenBlob;

/// Adjacent pixels in one row that are darker than the low threshold.
struct Run {
    std::uint16_t begin = 0;
    std::uint16_t end = 0;     ///< exclusive
    std::uint32_t mass = 0;    ///< sum of the pixel weights (low threshold minus grey level)
    std::uint32_t sum_x = 0;   ///< sum of weight times u, modulo 2^32
    bool passes_high = false;  ///< true if a pixel is darker than the high threshold
    OpenBlob* blob = nullptr;  ///< blob that contains the run, or null if there were too many blobs
};

/// Number of pixels that the search for dark pixels tests at a time. These pixels have the same low
/// threshold.
inline constexpr std::size_t kGroup_px = 8;
static_assert(kTileWidth_px % kGroup_px == 0);

/// Finds up to runs.size() runs of row `v`, from left to right. Returns the number of runs. A run
/// at the right image border may end beyond the border.
int find_runs(int v, const AdaptiveThreshold& threshold, std::span<Run> runs);

}  // namespace dotpose::core
