// Dark sums: how dark the pixels of a square are, and where in it. For processors without vectors,
// from a ring of the newest rows.
#pragma once

#include <cstdint>

namespace dotpose::core {

/// Rows one after the other; after the last comes the first.
struct RingRows {
    const std::uint8_t* end;  ///< after the last, in the column of the pixels that are read
    std::int32_t bytes;
    std::int32_t stride;

    const std::uint8_t* wrapped(const std::uint8_t* row) const {
        return row < end ? row : row - bytes;
    }
};

/// What the pixels darker than a level lack of it, and its sums weighted with their places from the
/// middle. Of at most 13 x 13 pixels: below 2^16, and 2^19 for the others.
struct DarkSums {
    std::int32_t mass = 0;
    std::int32_t x = 0;
    std::int32_t y = 0;
};

/// Of the square of 2 Half + 1 pixels per side that begins at `row`. With the side known, pixels of
/// a row are summed without a loop, and their places are constants.
template <int Half>
[[gnu::always_inline]] inline DarkSums dark_sums(const std::uint8_t* row, const RingRows& ring,
                                                 std::int32_t level) {
    const RingRows rows = ring;
    std::int32_t mass = 0;
    std::int32_t sum_x = 0;
    std::int32_t sum_y = 0;
    for (std::int32_t y = -Half; y <= Half; ++y) {
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
        row = rows.wrapped(row + rows.stride);
    }
    return {mass, sum_x, sum_y};
}

}  // namespace dotpose::core
