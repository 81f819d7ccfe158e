// Float fit: fits the pose, in single precision, to dots that were measured near their predicted
// image positions. It is a variant of `refine_pose` that uses vector kernels. Unlike the paper,
// which computes the pose from the grid (paper, equations 10-12), this fit uses the printed
// positions of the displaced dots.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// Fits the plane by least squares, starting from `plane`. In the first iteration, dots are inliers
/// if their squared residual is at most `limit`, in spacings^2. In later iterations, the limit for
/// the residual is about four times the standard deviation of one coordinate. Sets all members of
/// `fit` except `surface` and `uneven`. After kMaxRoundsOfFloats iterations, returns true even if
/// the fit has not converged. Returns false if there are fewer than kMinDots inliers, or if the
/// inliers do not determine the plane. In these cases, `plane` and `fit` must not be used.
bool fit_plane(const Kernels& kernels, const MeasuredDots& dots, int reach_px, float limit,
               float displacement, FloatPlane& plane, PoseFit& fit);

}  // namespace dotpose::core
