// Search: finds the position on one axis that agrees best with all lines in view. Unlike the paper,
// this search does not decode each line separately, and is not limited to the clearest 8 x 8
// symbols. See docs/differs-from-paper.md.
#pragma once

#include "core/decode/lines.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Returns the number of consecutive lines that determine a position. `libdots` needs more lines
/// than the other codes, because some strings of 6 digits occur more than once in its misprinted
/// sequence a4.
int run_length(CodeVariant code);

/// Returns the position and roll of the first line, given the position and roll of line `line`.
/// Sets `rolls` to the roll of each line minus the roll of the first line, modulo 63.
AxisReading reading_of_first(CodeVariant code, std::uint32_t position, int roll, int line,
                             std::span<std::uint8_t> rolls);

/// Finds the position on an axis from runs of consecutive lines, clearest run first. Tries the most
/// likely rolls of each line, and keeps the position with the highest total score. If any line
/// scores less at this position than at its best roll, also calls `search_by_steps`. Error:
/// not_in_code if the code contains none of the combinations of rolls that were tried.
Status find_axis(CodeVariant code, const Lines& lines, AxisReading& best);

/// Variant of `find_axis` for first attempts and devices. Tries only a few runs, with a few
/// readings each, and does not call `search_by_steps`. Few fixes are lost, because positions that
/// take longer to find are rarely certain.
Status find_axis_briefly(CodeVariant code, const Lines& lines, AxisReading& best);

}  // namespace dotpose::core
