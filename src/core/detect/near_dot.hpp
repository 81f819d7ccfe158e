// Near dot: the dot of an intersection whose place in the image is known. What is measured knows
// nothing of where the dot is expected, so that it can tell whether it is there.
#pragma once

#include "dotpose/stages.hpp"

namespace dotpose::core {

struct NearDot {
    Vec from_intersection_q8;  ///< px
    std::int32_t mass = 0;
};

/// False where there is no dot, or the square around the intersection leaves the image or the rows
/// that are kept.
bool measure_near_dot(const Tracking& tracking, Vec intersection_q16, NearDot& dot);

}  // namespace dotpose::core
