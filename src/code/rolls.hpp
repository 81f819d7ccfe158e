// Rolls: computes the rolls of columns and rows. The roll of a line is the index in the main
// sequence at which its bits begin. For adjacent lines, `follow_rolls` is faster than a call of
// `roll_from` for each line.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/code.hpp"

namespace dotpose::code {

/// Returns the roll of a column or row, in [0, 62]. `position` and `section` identify the line.
/// `cross` is the position of its first bit on the other axis.
int roll_from(CodeVariant code, std::uint32_t position, int section, std::uint32_t cross);

/// Returns the roll of a position in the code `other` minus its roll in the code `read`, modulo 63.
/// `place` is the place of the position in a4, the only sequence that differs between codes.
int roll_further(CodeVariant read, CodeVariant other, std::uint32_t position, std::uint32_t place);

/// Sets rolls[i] to the roll of line `position` + i. `first_roll` is the roll of line `position`.
/// The range may extend beyond the last position, because the roll differences are periodic.
void follow_rolls(CodeVariant code, std::uint32_t position, int first_roll,
                  std::span<std::uint8_t> rolls);

}  // namespace dotpose::code
