// Exact lines: where hardly a bit is misread, six bits of a line give its roll, and a comparison of
// words tells whether all its other bits agree. This takes a tenth of the time of scoring lines.
// Paper sections II-B.6 and II-B.7.
#pragma once

#include "core/decode/bit_lines.hpp"

namespace dotpose::core {

/// Returns the roll at cell 0 of a line of up to 64 cells whose bits all agree with the main
/// sequence at this roll; code::kAbsent if there is none, or no six adjacent bits were read.
std::uint8_t exact_roll(std::uint64_t bits, std::uint64_t valid);

/// Finds the place of cell (0, 0) of an upright block from exact lines. Returns false if too few
/// lines in a row are exact, or if more bits contradict the place than one in two lines.
bool find_place_exactly(Profile profile, const BitBlock& block, Place& place);

}  // namespace dotpose::core
