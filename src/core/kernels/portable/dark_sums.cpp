#include "core/kernels/portable/dark_sums.hpp"

namespace dotpose::core {
namespace {

/// With the width known, pixels of a row are summed without a loop, and their places are constants.
template <int Half>
DarkSums sums(const RingSquare& square, std::int32_t cut) {
    constexpr int kSide = 2 * Half + 1;
    DarkSums all;
    const std::uint8_t* row = square.top_left;
    for (std::int32_t y = -Half; y <= Half; ++y) {
        std::int32_t of_row = 0;
#pragma GCC unroll 16
        for (int i = 0; i < kSide; ++i) {
            const std::int32_t lack = cut - row[i];
            if (lack <= 0) continue;
            of_row += lack;
            all.x += (i - Half) * lack;
        }
        all.mass += of_row;
        all.y += y * of_row;
        row += square.stride;
        if (row >= square.ring_end) row -= square.ring_bytes;
    }
    return all;
}

}  // namespace

DarkSums dark_sums(const RingSquare& square, std::int32_t cut) {
    switch (square.half) {
        case kLeastHalf_px:
            return sums<3>(square, cut);
        case 4:
            return sums<4>(square, cut);
        case 5:
            return sums<5>(square, cut);
        case 6:
            return sums<6>(square, cut);
        default:
            return sums<kMostHalf_px>(square, cut);
    }
}

std::int32_t mean_of_corners(const RingSquare& square) {
    const std::uint8_t* bottom = square.top_left + 2 * square.half * square.stride;
    if (bottom >= square.ring_end) bottom -= square.ring_bytes;
    const int right = 2 * square.half;
    return (square.top_left[0] + square.top_left[right] + bottom[0] + bottom[right]) >> 2;
}

}  // namespace dotpose::core
