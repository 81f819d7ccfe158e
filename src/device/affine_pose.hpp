// Affine pose: the pose from all dots, in integers, for a camera that looks straight at the paper
// through a lens without distortion, or with corrected distortion.
#pragma once

#include "core/pose/observations.hpp"
#include "device/tracking.hpp"

namespace dotpose::core {

/// Fits the map from the centres of the dots to their printed places. Leaves out dots with large
/// residuals. Returns the number of dots used, or 0 if they do not determine the map, which is then
/// unchanged. Sets `displacement_q16` to the distance of a typical dot from its intersection, in
/// spacings.
int fit_affine_pose(const Observations& observations, PlaneFromImage& pattern_from_image,
                    std::int32_t& displacement_q16);

}  // namespace dotpose::core
