// Affine pose: fits the pose to all dots in integer arithmetic. Requires a camera that looks
// straight at the paper, and dot centres without lens distortion.
#pragma once

#include "core/pose/observations.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Fits the map from the image to the pattern, using the measured centres of the dots and their
/// printed positions. `pattern_from_image` contains the initial map and is set to the fitted map.
/// Excludes dots with large residuals. Sets `displacement_q16` to the median displacement of the
/// dots, in 2^-16 spacings. Returns the number of dots used. Returns 0 and leaves the map unchanged
/// if the dots do not determine it.
int fit_affine_pose(const Observations& observations, PlaneFromImage& pattern_from_image,
                    std::int32_t& displacement_q16);

}  // namespace dotpose::core
