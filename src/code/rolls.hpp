// Rolls of lines anywhere on the plane. Those of consecutive lines are computed together, which is
// quicker than one by one.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/code.hpp"

namespace dotpose::code {

/// Returns the roll, in [0, 63), of column (row) `position` of a section, counted from row (column)
/// `cross` on.
int roll_from(Profile profile, std::uint32_t position, int section, std::uint32_t cross);

/// Returns by how much the roll of a position in the profile `other` exceeds that in `read`, in [0,
/// 63). `place` is that of the position in a4, in which alone profiles differ.
int roll_further(Profile read, Profile other, std::uint32_t position, std::uint32_t place);

/// Sets rolls[i] to the roll of line `position` + i, given the roll of line `position`. Stepping by
/// differences also works across the end of the code.
void follow_rolls(Profile profile, std::uint32_t position, int first_roll,
                  std::span<std::uint8_t> rolls);

}  // namespace dotpose::code
