// Search: finds the position of an axis that agrees best with all lines in view. differs: the paper
// decodes the best 8 x 8 symbols one line at a time; docs/differs-from-paper.md.
#pragma once

#include "core/decode/lines.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Returns the number of consecutive lines that determine a position. The misprinted sequence of
/// libdots needs more lines, because only 7 consecutive differences are unique in it.
int run_length(CodeVariant code);

/// Returns the reading of the first line if line `line` is at `position` with `roll`. Sets the
/// rolls of all lines, modulo 63, relative to the roll of the first line.
AxisReading reading_of_first(CodeVariant code, std::uint32_t position, int roll, int line,
                             std::span<std::uint8_t> rolls);

/// Reads runs of consecutive lines, starting with the clearest run, each with its most likely
/// rolls, and keeps the position with the largest sum over all lines. If the score of this position
/// is not the maximum possible, searches by steps as well. Errors: not_in_code, if no reading
/// occurs in the code.
Status find_axis(CodeVariant code, const Lines& lines, AxisReading& best);

/// Reads only a few runs with a few readings each, for first attempts. A position that takes longer
/// to find is rarely certain.
Status find_axis_briefly(CodeVariant code, const Lines& lines, AxisReading& best);

}  // namespace dotpose::core
