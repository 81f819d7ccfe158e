// Float fit: fits the pose to dots that were measured in single precision near the places that the
// code predicts. Otherwise equivalent to `refine_pose`. Uses vector kernels. Differs: the paper
// computes the pose from the grid (eq. 10-12), without a fit to the displaced dots.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// Fits the plane by least squares, starting from `plane`. A dot is an inlier if its squared
/// residual is at most `limit` (spacings^2) in the first iteration. In later iterations, the limit
/// is about four standard deviations of one coordinate. Sets all members of `fit` except `surface`
/// and `uneven`. Returns false if there are fewer than kMinDots inliers, or if the inliers do not
/// determine the plane.
bool fit_plane(const Kernels& kernels, const MeasuredDots& dots, int reach_px, float limit,
               float displacement, FloatPlane& plane, PoseFit& fit);

}  // namespace dotpose::core
