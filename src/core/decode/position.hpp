// Position: decodes the turn of the grid and its place in the code (paper, sections II-B.6 and
// II-B.7).
#pragma once

#include "core/decode/grid.hpp"
#include "core/kernels/scores.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Decodes with the paper's method, as a baseline. A vote determines the turn. The best rolls of
/// the lines in the clearest 8 x 8 window determine the position. Errors: not_in_code, ambiguous,
/// grid_too_small. Returns grid_too_small if the window has fewer than 8 columns or rows, or if its
/// mean quality is below a third of the maximum.
Status decode_window(const Grid& grid, CodeVariant code, std::span<ScoredLine> storage,
                     Decoding& decoding);

/// Decodes all lines, and finds the position with the highest total score. Tries the most likely
/// turn first. Also tries the second most likely turn, unless the position is already clear
/// (`AxisReading::is_clear`). Errors: grid_too_small, not_in_code.
Status decode_all(const Grid& grid, CodeVariant code, std::span<ScoredLine> storage,
                  Decoding& decoding);

/// Bounded-time variant of `decode_all`, for devices. Few fixes are lost, because positions that
/// take longer to find are rarely certain. Errors: grid_too_small, not_in_code.
Status decode_briefly(const Grid& grid, CodeVariant code, std::span<ScoredLine> storage,
                      Decoding& decoding);

}  // namespace dotpose::core
