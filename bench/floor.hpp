/// Floor: the least that any method does that looks at all pixels.
#pragma once

#include <cstdint>
#include <span>

namespace dotpose::bench {

/// How many pixels are darker than `level`: one pass, threshold and count.
std::uint32_t count_dark(std::span<const std::uint8_t> pixels, std::uint8_t level);

}  // namespace dotpose::bench
