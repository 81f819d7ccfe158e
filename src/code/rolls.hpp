// Rolls: computes the rolls of single lines and of runs of consecutive lines. Computing a run in
// one call is faster than computing its rolls line by line.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/code.hpp"

namespace dotpose::code {

/// Returns the roll, in [0, 63), of line `position` (a column or a row) of a section, if the first
/// bit of the line is at position `cross` of the other axis.
int roll_from(CodeVariant code, std::uint32_t position, int section, std::uint32_t cross);

/// Returns the roll of a position in the code variant `other` minus its roll in the variant `read`,
/// modulo 63. `place` is the place of the position in a4, the only sequence that differs between
/// the variants.
int roll_further(CodeVariant read, CodeVariant other, std::uint32_t position, std::uint32_t place);

/// Sets rolls[i] to the roll of line `position` + i. `first_roll` is the roll of line `position`.
/// Lines may be beyond the last position, because the differences between rolls are periodic.
void follow_rolls(CodeVariant code, std::uint32_t position, int first_roll,
                  std::span<std::uint8_t> rolls);

}  // namespace dotpose::code
