// Processors of 64 bits and smaller ones.
#pragma once

#include <cstddef>

namespace dotpose::core {

/// Whether registers are of 64 bits. Processors that have them do several things at a time, and
/// lose more by a branch that they cannot predict than by what it would save.
inline constexpr bool kIsWide = sizeof(std::size_t) == 8;

}  // namespace dotpose::core
