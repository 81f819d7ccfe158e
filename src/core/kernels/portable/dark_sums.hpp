// Dark sums: how dark the pixels of a square are, and where in it. For processors without vectors.
#pragma once

#include <cstdint>

namespace dotpose::core {

/// What the pixels darker than a level lack of it, and its sums weighted with their places from the
/// middle. Of at most 11 x 11 pixels: below 2^15, and 2^18 for the others.
struct DarkSums {
    std::int32_t mass = 0;
    std::int32_t x = 0;
    std::int32_t y = 0;
};

/// Of the square of 2 Half + 1 pixels per side that begins at `row`. With the side known, pixels of
/// a row are summed without a loop, and their places are constants.
template <int Half>
[[gnu::always_inline]] inline DarkSums dark_sums(const std::uint8_t* row, std::int32_t stride,
                                                 std::int32_t level) {
    std::int32_t mass = 0;
    std::int32_t sum_x = 0;
    std::int32_t sum_y = 0;
    for (std::int32_t y = -Half; y <= Half; ++y, row += stride) {
        std::int32_t of_row = 0;
#pragma GCC unroll 16
        for (int i = 0; i <= 2 * Half; ++i) {
            // Most pixels are paper. Asked for its sign alone, a difference needs no comparison.
            const std::int32_t lack = level - row[i];
            if (lack < 0) continue;
            of_row += lack;
            sum_x += (i - Half) * lack;
        }
        mass += of_row;
        sum_y += y * of_row;
    }
    return {mass, sum_x, sum_y};
}

}  // namespace dotpose::core
