// Search: finds the position on one axis that agrees best with all lines in view. Differs: the
// paper decodes the clearest 8 x 8 symbols, one line at a time. See docs/differs-from-paper.md.
#pragma once

#include "core/decode/lines.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Returns the number of consecutive lines that determine a position. `libdots` needs more lines,
/// because strings of fewer than 7 digits are not unique in its misprinted secondary sequence.
int run_length(CodeVariant code);

/// Returns the position and the roll of the first line, given that the line with index `line` is at
/// `position` and has the roll `roll`. Sets `rolls` to the roll of each line minus the roll of the
/// first line, modulo 63.
AxisReading reading_of_first(CodeVariant code, std::uint32_t position, int roll, int line,
                             std::span<std::uint8_t> rolls);

/// Reads the position from runs of consecutive lines, starting with the clearest run, and tries the
/// most likely rolls of each line. Keeps the position with the highest score over all lines. If
/// this score is below the maximum possible and there are at least `run_length(code)` lines, also
/// calls `search_by_steps`. Error: not_in_code if no reading occurs in the code.
Status find_axis(CodeVariant code, const Lines& lines, AxisReading& best);

/// Variant of `find_axis` for first attempts. Reads only a few runs with a few readings each, and
/// does not call `search_by_steps`, because a position that takes longer to find is rarely certain.
Status find_axis_briefly(CodeVariant code, const Lines& lines, AxisReading& best);

}  // namespace dotpose::core
