// Covariance: propagates the uncertainty of the fitted plane to the pose.
#pragma once

#include "core/pose/refine_pose.hpp"
#include "dotpose/fix.hpp"

namespace dotpose::core {

/// Sets `covariance`, `residual_px`, `dots_seen`, `dots_used` and `surface` in the fix. The
/// covariance is that of the pose at the reference point. The fix must already contain the spacing.
void estimate_covariance(const PoseFit& fit, const PlaneFromImage& pattern_from_image,
                         FixedVec reference_q8, Fix& fix);

}  // namespace dotpose::core
