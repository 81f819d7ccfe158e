// Float fit: fits the pose to dots that were measured at their places in the code. Equivalent to
// `refine_pose`, but for dots that were measured in single precision. Uses vector kernels. Differs:
// the paper stops at eq. 12.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// Fits the plane by least squares, starting from `plane`. A dot is an inlier if its squared
/// residual is at most `limit` (spacings^2) in the first iteration. In later iterations, the limit
/// is four standard deviations. Sets all members of `fit` except `surface` and `uneven`. Returns
/// false if there are fewer than kMinDots inliers, or if the inliers do not determine the plane.
bool fit_plane(const Kernels& kernels, const MeasuredDots& dots, int reach_px, float limit,
               float displacement, FloatPlane& plane, PoseFit& fit);

}  // namespace dotpose::core
