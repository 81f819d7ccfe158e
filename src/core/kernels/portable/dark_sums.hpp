// Dark sums: mass and moments of the dark pixels of a square, for processors without vector
// instructions.
#pragma once

#include <cstdint>

#include "core/noinline.hpp"

namespace dotpose::core {

/// Sums, over the pixels of a square, of the darkness below a level: unweighted (mass), and
/// weighted with the signed distance from the middle of the square along x and y. For at most 11 x
/// 11 pixels, the mass is below 2^15 and the moments are below 2^18.
struct DarkSums {
    std::int32_t mass = 0;
    std::int32_t x = 0;
    std::int32_t y = 0;
};

/// Half side of the squares for which `dark_sums` adds only a diamond. At the dot sizes that can be
/// tracked, no pixel in the excluded corners is more than half as dark as the centre of the dot.
inline constexpr int kHalfOfDiamond = 2;

/// Returns the sums of a square of 2 Half + 1 pixels per side whose upper left pixel is at `row`.
/// Excludes the corners if Half is kHalfOfDiamond. The size is a compile-time constant, so the
/// pixels of a row are summed without a loop, and the coordinates of the pixels are constants. Not
/// inlined, so that small processors keep all variables in registers.
template <int Half>
DOTPOSE_NOINLINE inline DarkSums dark_sums(const std::uint8_t* row, std::int32_t stride,
                                           std::int32_t level) {
    std::int32_t mass = 0;
    std::int32_t sum_x = 0;
    std::int32_t cumulative = 0;  // sum of the values of `mass` after each row
    const auto add_row = [&](int reach) {
#pragma GCC unroll 16
        for (int x = -reach; x <= reach; ++x) {
            // Most pixels are paper. The sign of the difference identifies paper without a second
            // comparison.
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
    // Let m(y) be the mass of row y, with y from -Half to Half. Then `cumulative` is the sum of
    // (Half + 1 - y) m(y), and the difference is the sum of y m(y).
    return {mass, sum_x, (Half + 1) * mass - cumulative};
}

}  // namespace dotpose::core
