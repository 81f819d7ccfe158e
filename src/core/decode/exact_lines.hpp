// Exact lines: a fast decoder for blocks with few misread bits (paper, sections II-B.6 and II-B.7).
// Six adjacent bits of a line determine its roll. A word comparison then checks all other bits of
// the line. This is ten times as fast as scoring the lines.
#pragma once

#include "core/decode/bit_lines.hpp"

namespace dotpose::core {

/// Returns the roll of an exact line at cell 0, or code::kAbsent if the line is not exact. In an
/// exact line, all valid bits agree with the main sequence, and at least six adjacent bits are
/// valid. Lines have up to 64 cells.
std::uint8_t exact_roll(std::uint64_t bits, std::uint64_t valid);

/// Finds the place of cell (0, 0) in an upright block from exact lines (see `exact_roll`). Skips
/// the first quarter of the lines on each axis. The remaining lines must include `run_length(code)`
/// adjacent exact lines, whose rolls must occur in the code. An axis must have at most half as many
/// wrong bits as lines. Returns false if an axis fails one of these conditions.
bool find_place_exactly(CodeVariant code, const BitBlock& block, Place& place);

}  // namespace dotpose::core
