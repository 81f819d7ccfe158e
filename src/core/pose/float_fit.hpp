// Float fit: fits the pose to dots that were measured near their predicted places, in single
// precision. Variant of `refine_pose` with vector kernels. Unlike the paper, which computes the
// pose from the grid (eq. 10-12), this fit uses the displaced dots.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// Fits the plane by least squares, starting from `plane`. In the first iteration, inliers have
/// squared residuals of at most `limit` (spacings^2). In later iterations, the limit corresponds to
/// about four standard deviations of one coordinate. Sets all members of `fit` except `surface` and
/// `uneven`. Returns false if there are fewer than kMinDots inliers, or if the inliers do not
/// determine the plane.
bool fit_plane(const Kernels& kernels, const MeasuredDots& dots, int reach_px, float limit,
               float displacement, FloatPlane& plane, PoseFit& fit);

}  // namespace dotpose::core
