// Near dot: the dot of an intersection whose place in the image is known. What is read knows
// nothing of which dot is expected, so that it can tell whether it is there.
#pragma once

#include "dotpose/code.hpp"
#include "dotpose/stages.hpp"

namespace dotpose::core {

/// Halves of the squares around intersections that can be looked at.
inline constexpr int kLeastHalf_px = 4;
inline constexpr int kMostHalf_px = 6;

/// Level of the paper around an intersection, from the corners of its square, which no dot reaches.
/// 0 where the square leaves the image or the rows that are kept.
std::int32_t paper_around(const Tracking& tracking, Vec intersection_q16);

/// Which of the four places is darkest, where one clearly is. `depth` is half of what a dot lacks of
/// the paper's level.
struct Reading {
    Symbol symbol;
    bool is_clear;
};
Reading read_symbol(const Tracking& tracking, Vec intersection_q16, std::int32_t paper,
                    std::int32_t depth);

struct NearDot {
    Vec off_q8;  ///< of its centre from where it was looked for, px
    std::int32_t mass = 0;
};

/// The centre of what is darker than `level` in the square of 2 half + 1 px around a place; half is
/// 2 to 6. False where that is no dot. All of the square is kept.
bool measure_dot(const Tracking& tracking, Vec place_q16, int half, std::int32_t level,
                 NearDot& dot);

}  // namespace dotpose::core
