// Float fit: fits the pose to dots that were measured at their places in the code. Like
// `refine_pose`, but with vectors and in single precision. differs: the paper stops at eq. 12.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// Fits the plane by least squares, starting from `plane`. Dots are inliers if their squared
/// residual (in spacings^2) is at most `limit` in the first round, and at most four standard
/// deviations in the last round. Sets all members of `fit`. Returns false if the dots do not
/// determine the plane.
bool fit_plane(const Kernels& kernels, const MeasuredDots& dots, int reach_px, float limit,
               float displacement, FloatPlane& plane, PoseFit& fit);

}  // namespace dotpose::core
