/// Counts dark pixels. Any method that reads all pixels takes at least as long.
#pragma once

#include <cstdint>
#include <span>

namespace dotpose::bench {

/// Returns the number of pixels darker than `level`.
std::uint32_t count_dark(std::span<const std::uint8_t> pixels, std::uint8_t level);

}  // namespace dotpose::bench
