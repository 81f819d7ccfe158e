// Exact lines: a fast decoder for blocks with few misread bits (paper, sections II-B.6 and II-B.7).
// Six adjacent bits of a line determine its roll. A word comparison then checks all other bits of
// the line. This decoder is ten times as fast as scoring the lines.
#pragma once

#include "core/decode/bit_lines.hpp"

namespace dotpose::core {

/// Returns the roll of a line of up to 64 cells, or code::kAbsent if the line is not exact. A line
/// is *exact* if all valid bits agree with the main sequence at one roll, and at least six adjacent
/// bits are valid.
std::uint8_t exact_roll(std::uint64_t bits, std::uint64_t valid);

/// Finds the place of cell (0, 0) in an upright block from exact lines (see `exact_roll`). Skips
/// the first quarter of the lines on each axis. Among the other lines, `run_length(code)` adjacent
/// lines must be exact, and the code must contain their rolls. On each axis, the number of wrong
/// bits must be at most half the number of lines. Returns false if one of these conditions is not
/// met.
bool find_place_exactly(CodeVariant code, const BitBlock& block, Place& place);

}  // namespace dotpose::core
