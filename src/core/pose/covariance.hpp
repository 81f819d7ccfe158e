// Covariance: computes the covariance of the pose from the residuals of its fit.
#pragma once

#include "core/pose/refine_pose.hpp"
#include "dotpose/fix.hpp"

namespace dotpose::core {

/// Sets `covariance`, `residual_px`, `dots_seen`, `dots_used` and `surface` of the fix for the pose
/// at the reference point.
void estimate_covariance(const PoseFit& fit, const PlaneFromImage& pattern_from_image,
                         FixedVec reference_q8, Fix& fix);

}  // namespace dotpose::core
