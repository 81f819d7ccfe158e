// Position: the turn and the place in the code. Paper sections II-B.6 and II-B.7.
#pragma once

#include "core/decode/grid.hpp"
#include "core/kernels/scores.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// The decoder of the paper, as a baseline: orientation by vote, and weighted correlation of each
/// line of the best 8 x 8 symbols. Errors: grid_too_small, not_in_code, ambiguous.
Status decode_window(const Grid& grid, CodeVariant code, std::span<ScoredLine> storage,
                     Decoding& decoding);

/// Decodes all dots: correlates all lines with weights, and finds the position with the largest sum
/// of scores. Tries the two most likely turns and keeps the turn with the larger sum. Errors:
/// grid_too_small, not_in_code.
Status decode_all(const Grid& grid, CodeVariant code, std::span<ScoredLine> storage,
                  Decoding& decoding);

/// Decodes all dots in bounded time, for first attempts. A position that takes longer to find is
/// rarely certain.
Status decode_briefly(const Grid& grid, CodeVariant code, std::span<ScoredLine> storage,
                      Decoding& decoding);

}  // namespace dotpose::core
