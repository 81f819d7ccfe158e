// Tracked pose: computes the map from image to pattern for a tracked frame, in integer arithmetic.
#pragma once

#include "device/tracking.hpp"

namespace dotpose::core {

/// Fits `pattern_from_image` to the dots that were read. Sets `displacement_q16` to the mean
/// displacement of the dots, in 2^-16 spacings. Returns the number of dots used, or 0 if the dots
/// do not determine `pattern_from_image`.
int fit_tracked_pose(const Tracking& tracking, PlaneFromImage& pattern_from_image,
                     std::int32_t& displacement_q16);

}  // namespace dotpose::core
