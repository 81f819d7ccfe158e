// Exact lines: decodes blocks with few misread bits. Six adjacent bits of a line determine its
// roll, and a comparison of words checks all other bits of the line. This is ten times as fast as
// scoring the lines. Paper sections II-B.6 and II-B.7.
#pragma once

#include "core/decode/bit_lines.hpp"

namespace dotpose::core {

/// Returns the roll, at cell 0, at which all valid bits of a line of up to 64 cells agree with the
/// main sequence. Returns code::kAbsent if there is no such roll, or if the line does not have six
/// adjacent valid bits.
std::uint8_t exact_roll(std::uint64_t bits, std::uint64_t valid);

/// Finds the place of cell (0, 0) of an upright block from its exact lines. A line is exact if
/// `exact_roll` finds its roll. On each axis, the last three quarters of the lines must contain
/// `run_length(code)` adjacent exact lines, and their rolls must occur in the code. The number of
/// bit errors at the resulting place must not exceed half the number of lines of the axis. Returns
/// false if either axis fails one of these conditions.
bool find_place_exactly(CodeVariant code, const BitBlock& block, Place& place);

}  // namespace dotpose::core
