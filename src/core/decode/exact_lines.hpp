// Exact lines: decoding of lines with few misread bits. Six bits of a line determine its roll, and
// a comparison of words checks all its other bits. This takes a tenth of the time that scoring the
// lines takes. Paper sections II-B.6 and II-B.7.
#pragma once

#include "core/decode/bit_lines.hpp"

namespace dotpose::core {

/// Returns the roll, at cell 0, of a line of up to 64 cells whose bits all agree with the main
/// sequence. Returns code::kAbsent if there is no such roll, or if the line has no six adjacent
/// bits.
std::uint8_t exact_roll(std::uint64_t bits, std::uint64_t valid);

/// Finds the place of cell (0, 0) of an upright block from exact lines: lines for which
/// `exact_roll` returns a roll. Returns false if, on either axis, the last three quarters of the
/// lines contain no `run_length(code)` adjacent exact lines, if their rolls do not occur in the
/// code, or if the columns or the rows have more bit errors at the place than half the number of
/// their lines.
bool find_place_exactly(CodeVariant code, const BitBlock& block, Place& place);

}  // namespace dotpose::core
