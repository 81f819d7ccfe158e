// Exact lines: a fast decoder for blocks with few misread bits (paper, sections II-B.6 and II-B.7).
// Six adjacent bits of a line determine its roll. A single comparison of two words then checks all
// other bits of the line. This decoder is ten times as fast as scoring the lines.
#pragma once

#include "core/decode/bit_lines.hpp"

namespace dotpose::core {

/// Returns the roll of a line of up to 64 cells, or code::kAbsent if the line is not exact. A line
/// is *exact* if all valid bits agree with the main sequence at one roll, and at least six adjacent
/// bits are valid.
std::uint8_t exact_roll(std::uint64_t bits, std::uint64_t valid);

/// Finds the place of cell (0, 0) in an upright block. On each axis, skips the first quarter of the
/// lines, and decodes the first run of `run_length(code)` adjacent exact lines (see `exact_roll`).
/// Returns false if an axis has no such run, if the code does not contain the rolls of the run, or
/// if the number of wrong bits on an axis is more than half the number of lines.
bool find_place_exactly(CodeVariant code, const BitBlock& block, Place& place);

}  // namespace dotpose::core
