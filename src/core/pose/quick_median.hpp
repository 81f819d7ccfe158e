// Quick median: of some hundred values, without a branch for each, which would be guessed wrong
// every other time.
#pragma once

#include <cstdint>
#include <span>

namespace dotpose::core {

/// The same as `median`.
std::int32_t quick_median(std::span<const std::int32_t> values);

}  // namespace dotpose::core
