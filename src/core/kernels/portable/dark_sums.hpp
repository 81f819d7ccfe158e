// Dark sums: mass and moments of the dark pixels of a square, for processors without vectors.
#pragma once

#include <cstdint>

#include "core/noinline.hpp"

namespace dotpose::core {

/// Sums of the darkness of pixels below a level: alone (mass), and times their distance from the
/// middle. For at most 11 x 11 pixels the mass is below 2^15 and the moments are below 2^18.
struct DarkSums {
    std::int32_t mass = 0;
    std::int32_t x = 0;
    std::int32_t y = 0;
};

/// Half size of the squares from which the corners are excluded: pixels farther from the middle
/// than a limit of steps. Dots of tracked sizes have no pixels there that are more than half as
/// dark as their middle.
inline constexpr int kHalfOfDiamond = 2;

/// Returns the sums of a square of 2 Half + 1 pixels per side that begins at `row`. As its size is
/// known, pixels of a row are summed without a loop, and their places are constants.
// Not inlined, so that small processors can keep everything in registers.
template <int Half>
DOTPOSE_NOINLINE inline DarkSums dark_sums(const std::uint8_t* row, std::int32_t stride,
                                           std::int32_t level) {
    std::int32_t mass = 0;
    std::int32_t sum_x = 0;
    std::int32_t so_far = 0;  // sum over the rows of the mass up to each row
    const auto add_row = [&](int reach) {
#pragma GCC unroll 16
        for (int x = -reach; x <= reach; ++x) {
            // Most pixels are paper. The sign of a difference needs no comparison.
            const std::int32_t lack = level - row[Half + x];
            if (lack < 0) continue;
            mass += lack;
            sum_x += x * lack;
        }
        so_far += mass;
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
    // `so_far` contains the mass of row y (-Half to Half) Half + 1 - y times. The difference is the
    // sum of y times the mass of row y.
    return {mass, sum_x, (Half + 1) * mass - so_far};
}

}  // namespace dotpose::core
