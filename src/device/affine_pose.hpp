// Affine pose: fits the pose to all dots, in integer arithmetic, for a camera that looks straight
// at the paper. The lens must have no distortion, or its distortion must be corrected.
#pragma once

#include "core/pose/observations.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Fits the map from the centres of the dots to their printed places. Excludes dots with large
/// residuals. Sets `displacement_q16` to the distance of a typical dot from its intersection, in
/// units of 2^-16 spacings. Returns the number of dots used. Returns 0, with an unchanged map, if
/// the dots do not determine the map.
int fit_affine_pose(const Observations& observations, PlaneFromImage& pattern_from_image,
                    std::int32_t& displacement_q16);

}  // namespace dotpose::core
