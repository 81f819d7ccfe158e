/// Counts dark pixels, as a lower bound of the time of any method that reads all pixels.
#pragma once

#include <cstdint>
#include <span>

namespace dotpose::bench {

/// Returns the number of pixels that are darker than `level`.
std::uint32_t count_dark(std::span<const std::uint8_t> pixels, std::uint8_t level);

}  // namespace dotpose::bench
