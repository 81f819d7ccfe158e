// Position: decodes the turn of the grid and its place in the code. Paper sections II-B.6 and
// II-B.7.
#pragma once

#include "core/decode/grid.hpp"
#include "core/kernels/scores.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Decodes with the method of the paper, as a baseline. Finds the turn by a vote, correlates each
/// line of the clearest window of 8 x 8 cells with the main sequence, and uses the best roll of
/// each line. Errors: grid_too_small (also if the mean quality of the cells is less than a third of
/// the maximum), not_in_code, ambiguous.
Status decode_window(const Grid& grid, CodeVariant code, std::span<ScoredLine> storage,
                     Decoding& decoding);

/// Decodes all dots: correlates all lines with the main sequence, and finds the position with the
/// highest sum of scores. Tries the most likely turn and, unless the position is already clear
/// (`AxisReading::is_clear`), the second most likely turn. Keeps the turn with the higher sum.
/// Errors: grid_too_small, not_in_code.
Status decode_all(const Grid& grid, CodeVariant code, std::span<ScoredLine> storage,
                  Decoding& decoding);

/// Decodes all dots in bounded time, for first attempts. A position that takes longer to find is
/// rarely certain. Errors: same as `decode_all`.
Status decode_briefly(const Grid& grid, CodeVariant code, std::span<ScoredLine> storage,
                      Decoding& decoding);

}  // namespace dotpose::core
