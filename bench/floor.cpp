#include "floor.hpp"

#include <algorithm>
#include <array>

namespace dotpose::bench {
namespace {

/// Number of lanes that count pixels in parallel. Each lane is an 8-bit counter, which allows the
/// compiler to use the widest vectors of the processor.
constexpr std::size_t kLanes = 64;
/// Maximum number of steps before an 8-bit lane can overflow.
constexpr std::size_t kMaxSteps = 255;

std::uint32_t count_steps(std::span<const std::uint8_t> pixels, std::uint8_t level) {
    std::array<std::uint8_t, kLanes> counts{};
    for (std::size_t at = 0; at < pixels.size(); at += kLanes) {
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            counts[lane] = static_cast<std::uint8_t>(counts[lane] + (pixels[at + lane] < level));
    }
    std::uint32_t sum = 0;
    for (const std::uint8_t count : counts)
        sum += count;
    return sum;
}

}  // namespace

std::uint32_t count_dark(std::span<const std::uint8_t> pixels, std::uint8_t level) {
    std::uint32_t count = 0;
    while (pixels.size() >= kLanes) {
        const std::size_t size = kLanes * std::min(pixels.size() / kLanes, kMaxSteps);
        count += count_steps(pixels.first(size), level);
        pixels = pixels.subspan(size);
    }
    for (const std::uint8_t pixel : pixels)
        count += pixel < level;
    return count;
}

}  // namespace dotpose::bench
