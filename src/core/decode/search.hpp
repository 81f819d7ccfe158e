// Search: finds the position of an axis that agrees best with all lines in view. differs: the paper
// decodes the best 8 x 8 symbols one line at a time; docs/differs-from-paper.md.
#pragma once

#include "core/decode/lines.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Returns the number of consecutive lines that determine a position. The misprinted sequence of
/// libdots needs more lines, because its strings of fewer than 7 consecutive differences are not
/// unique.
int run_length(CodeVariant code);

/// Returns the position and roll of the first line if line `line` is at `position` with `roll`.
/// Sets `rolls` to the roll of each line minus the roll of the first line, modulo 63.
AxisReading reading_of_first(CodeVariant code, std::uint32_t position, int roll, int line,
                             std::span<std::uint8_t> rolls);

/// Reads runs of consecutive lines, clearest run first, with the most likely rolls of each line.
/// Keeps the position with the highest score over all lines. If this score is below the maximum
/// possible and there are at least `run_length(code)` lines, also calls `search_by_steps`. Error:
/// not_in_code if no reading occurs in the code.
Status find_axis(CodeVariant code, const Lines& lines, AxisReading& best);

/// Variant of `find_axis` for first attempts. Reads only a few runs with a few readings each, and
/// does not call `search_by_steps`, because a position that takes longer to find is rarely certain.
Status find_axis_briefly(CodeVariant code, const Lines& lines, AxisReading& best);

}  // namespace dotpose::core
