// Search: finds the position on one axis that agrees best with all lines in view. Unlike the paper,
// this search does not decode each line separately, and is not limited to the clearest 8 x 8
// symbols. See docs/differs-from-paper.md.
#pragma once

#include "core/decode/lines.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Returns the number of consecutive lines that determine a position. `libdots` needs more lines,
/// because strings of fewer than 7 digits repeat in its misprinted secondary sequence.
int run_length(CodeVariant code);

/// Computes the position and roll of the first line from the position and roll of line `line`. Sets
/// `rolls` to the rolls of all lines relative to the first line, modulo 63.
AxisReading reading_of_first(CodeVariant code, std::uint32_t position, int roll, int line,
                             std::span<std::uint8_t> rolls);

/// Finds the position on an axis from runs of consecutive lines, clearest run first. Tries the most
/// likely rolls of each line, and keeps the position with the highest total score. If any line
/// scores less at this position than at its best roll, also calls `search_by_steps`. Error:
/// not_in_code if the code contains none of the combinations of rolls that were tried.
Status find_axis(CodeVariant code, const Lines& lines, AxisReading& best);

/// Variant of `find_axis` for first attempts and devices. Tries only a few runs, with a few
/// readings each, and does not call `search_by_steps`. A position that takes longer to find is
/// rarely certain.
Status find_axis_briefly(CodeVariant code, const Lines& lines, AxisReading& best);

}  // namespace dotpose::core
