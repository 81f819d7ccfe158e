// Covariance: propagates the uncertainty of the fitted plane to the pose.
#pragma once

#include "core/pose/refine_pose.hpp"
#include "dotpose/fix.hpp"

namespace dotpose::core {

/// Sets the `covariance` of the fix at the reference point, and its `residual_px`, `dots_seen`,
/// `dots_used` and `surface`. The fix must already contain the spacing.
void estimate_covariance(const PoseFit& fit, const PlaneFromImage& pattern_from_image,
                         FixedVec reference_q8, Fix& fix);

}  // namespace dotpose::core
