/// Minimum work of any method that reads all pixels. Its time is a lower bound for these methods.
#pragma once

#include <cstdint>
#include <span>

namespace dotpose::bench {

/// Returns the number of pixels that are darker than `level`, in one pass.
std::uint32_t count_dark(std::span<const std::uint8_t> pixels, std::uint8_t level);

}  // namespace dotpose::bench
