// Rolls of consecutive lines, one after the other: quicker than each by itself.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/code.hpp"

namespace dotpose::code {

/// Sets rolls[i] to that of the line `position` + i, where the first of them shows `first_roll`.
/// Stepping by differences carries over the end of the code.
void follow_rolls(Profile profile, std::uint32_t position, int first_roll,
                  std::span<std::uint8_t> rolls);

}  // namespace dotpose::code
