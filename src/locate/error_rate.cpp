#include "dotpose/error_rate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "locate/near_cells.hpp"

namespace dotpose {
namespace {

/// Maximum number of bits at settled places. When it is exceeded, their counts are halved, so that
/// the rate follows changes of the light or the paper.
constexpr int kMaxSettled = 1 << 15;
/// Frames with more bits are ignored, so that no sum overflows. No image has this many dots.
constexpr int kMaxCount = 1 << 20;

/// Returns true if the frames may show some of the same dots: if their cells differ along each axis
/// by less than twice the side of a square with all dots of a frame.
bool are_near(const ComparedBits& a, const ComparedBits& b) {
    const auto side =
        static_cast<std::uint32_t>(std::sqrt(2 * static_cast<float>(std::max(a.count, b.count))));
    return core::are_near(a.cell, b.cell, side);
}

}  // namespace

void ErrorRate::add(const ComparedBits& frame) {
    if (frame.count <= 0 || frame.count > kMaxCount || frame.wrong < 0 || frame.wrong > frame.count)
        return;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        ComparedBits& place = places_[i];
        if (place.count == 0 || !are_near(place, frame)) continue;
        // The number of bits and the cell remain those of the first frame. If the cell followed a
        // slow camera, the camera would never reach another place.
        place.wrong = std::max(place.wrong, frame.wrong);
        latest_ = i;
        return;
    }
    settle(places_[oldest_]);
    places_[oldest_] = frame;
    latest_ = oldest_;
    oldest_ = (oldest_ + 1) % places_.size();
}

void ErrorRate::settle(const ComparedBits& place) {
    settled_ += place.count;
    settled_wrong_ += place.wrong;
    while (settled_ > kMaxSettled) {
        settled_ /= 2;
        settled_wrong_ = (settled_wrong_ + 1) / 2;
    }
}

int ErrorRate::bits_per_error() const {
    int count = settled_ - places_[latest_].count;
    int wrong = settled_wrong_;
    for (const ComparedBits& place : places_) {
        count += place.count;
        wrong += place.wrong;
    }
    const auto k = static_cast<float>(wrong);
    const float limit = static_cast<float>(count) / (k + 2 * std::sqrt(k) + 3);
    return std::min(static_cast<int>(limit), kMaxBitsPerError);
}

}  // namespace dotpose
