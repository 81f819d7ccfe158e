// Dark sums: mass and moments of the dark pixels in a square, for processors without vector
// instructions.
#pragma once

#include <cstdint>

#include "core/noinline.hpp"

namespace dotpose::core {

/// Darkness sums over a square. The darkness of a pixel is max(level - pixel, 0). The mass is below
/// 2^15, and the moments are below 2^18, for squares of up to 11 x 11 pixels.
struct DarkSums {
    std::int32_t mass = 0;  ///< sum of the darkness
    std::int32_t x = 0;     ///< sum of x * darkness, with x = 0 in the middle column
    std::int32_t y = 0;     ///< sum of y * darkness, with y = 0 in the middle row
};

/// Half-width at which `dark_sums` skips the corners of the square and sums only a diamond. At all
/// dot sizes that can be tracked, no corner pixel is more than half as dark as the centre of the
/// dot, so the corners contribute little.
inline constexpr int kHalfOfDiamond = 2;

/// Returns the darkness sums over a square with 2 Half + 1 pixels per side, or over a diamond if
/// Half is kHalfOfDiamond. `row` points to the upper left pixel of the square. The size is a
/// template argument so that compilers unroll the loops. Not inlined on processors with few
/// registers, because the caller would otherwise run out of registers.
template <int Half>
DOTPOSE_NOINLINE inline DarkSums dark_sums(const std::uint8_t* row, std::int32_t stride,
                                           std::int32_t level) {
    std::int32_t mass = 0;
    std::int32_t sum_x = 0;
    std::int32_t cumulative = 0;  // running total of `mass`, updated after each row
    const auto add_row = [&](int reach) {
#pragma GCC unroll 16
        for (int x = -reach; x <= reach; ++x) {
            // Skips paper, which makes up most of the pixels. The sign of the difference already
            // identifies paper, so no second comparison is needed.
            const std::int32_t darkness = level - row[Half + x];
            if (darkness < 0) continue;
            mass += darkness;
            sum_x += x * darkness;
        }
        cumulative += mass;
        row += stride;
    };
    if constexpr (Half == kHalfOfDiamond) {
        add_row(0);
        add_row(1);
        add_row(2);
        add_row(1);
        add_row(0);
    } else {
        for (int y = -Half; y <= Half; ++y)
            add_row(Half);
    }
    // If m(y) is the mass of row y, with y from -Half to Half, then `cumulative` is the sum of
    // (Half + 1 - y) m(y). The last element of the result is therefore the sum of y m(y).
    return {mass, sum_x, (Half + 1) * mass - cumulative};
}

}  // namespace dotpose::core
