// Rolls of lines, singly and for runs of consecutive lines. A run is computed together, which is
// faster than line by line.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/code.hpp"

namespace dotpose::code {

/// Returns the roll, in [0, 63), of column (row) `position` of a section, if row (column) `cross`
/// is the first of its bits.
int roll_from(CodeVariant code, std::uint32_t position, int section, std::uint32_t cross);

/// Returns the roll of a position in the code variant `other` minus its roll in `read`, in [0, 63).
/// `place` is the place of the position in a4, the only sequence that differs between the variants.
int roll_further(CodeVariant read, CodeVariant other, std::uint32_t position, std::uint32_t place);

/// Sets rolls[i] to the roll of line `position` + i, given the roll of line `position`. The lines
/// may go beyond the end of the code, because the rolls are sums of differences.
void follow_rolls(CodeVariant code, std::uint32_t position, int first_roll,
                  std::span<std::uint8_t> rolls);

}  // namespace dotpose::code
