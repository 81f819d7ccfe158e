#include "dotpose/error_rate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace dotpose {
namespace {

/// Maximum number of counted bits. When it is exceeded, both counts are halved, so that the rate
/// follows changes of the light or the paper.
constexpr int kMaxCount = 1 << 15;

/// Returns true if the frames may show some of the same dots: if their cells differ along each axis
/// by less than twice the side of a square with all dots of a frame.
bool are_near(const ComparedBits& a, const ComparedBits& b) {
    const auto side =
        static_cast<std::uint32_t>(std::sqrt(2 * static_cast<float>(std::max(a.count, b.count))));
    const auto is_near = [side](std::uint32_t c, std::uint32_t d) {
        const std::uint32_t apart = c > d ? c - d : d - c;
        return std::min(apart, kPositionsPerAxis - apart) < side;
    };
    return is_near(a.cell.x, b.cell.x) && is_near(a.cell.y, b.cell.y);
}

}  // namespace

void ErrorRate::add(const ComparedBits& frame) {
    if (frame.count <= 0) return;
    if (here_.count > 0 && are_near(here_, frame)) {
        // The number of bits remains that of the first frame, and its cell too, because a slow
        // camera would otherwise never reach another place.
        here_.wrong = std::max(here_.wrong, frame.wrong);
        return;
    }
    count_ += here_.count;
    wrong_ += here_.wrong;
    here_ = frame;
    if (count_ <= kMaxCount) return;
    count_ /= 2;
    wrong_ = (wrong_ + 1) / 2;
}

int ErrorRate::bits_per_error() const {
    const auto wrong = static_cast<float>(wrong_ + here_.wrong);
    return static_cast<int>(static_cast<float>(count_) / (wrong + 2 * std::sqrt(wrong) + 3));
}

}  // namespace dotpose
