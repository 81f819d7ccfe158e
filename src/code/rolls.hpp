// Rolls anywhere on the plane; those of consecutive lines one after the other, which is quicker
// than each by itself.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/code.hpp"

namespace dotpose::code {

/// The roll in [0, 63) that the column (row) `position` of a section shows from the row (column)
/// `cross` on.
int roll_from(Profile profile, std::uint32_t position, int section, std::uint32_t cross);

/// Sets rolls[i] to that of the line `position` + i, where the first of them shows `first_roll`.
/// Stepping by differences carries over the end of the code.
void follow_rolls(Profile profile, std::uint32_t position, int first_roll,
                  std::span<std::uint8_t> rolls);

}  // namespace dotpose::code
