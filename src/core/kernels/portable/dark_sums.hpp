// Dark sums: how dark the pixels of a square are, and where in it, in integers and without a
// frame: rows are read from a ring of the newest ones.
#pragma once

#include <cstdint>

#include "dotpose/stages.hpp"

namespace dotpose::core {

/// A square of 2 half + 1 pixels per side within a ring of rows.
struct RingSquare {
    const std::uint8_t* top_left;
    const std::uint8_t* ring_end;  ///< after the last row of the ring, in the square's first column
    std::int32_t ring_bytes;
    std::int32_t stride;
    int half;
};

/// What the pixels darker than `cut` lack, and its sums weighted with their places from the
/// middle. At most 15 x 15 pixels, so below 2^16, and 2^19 for the others.
struct DarkSums {
    std::int32_t mass = 0;
    std::int32_t x = 0;
    std::int32_t y = 0;
};

/// Halves of squares that are summed.
inline constexpr int kLeastHalf_px = 3;
inline constexpr int kMostHalf_px = 7;

DarkSums dark_sums(const RingSquare& square, std::int32_t cut);

/// Mean of the four corners.
std::int32_t mean_of_corners(const RingSquare& square);

}  // namespace dotpose::core
