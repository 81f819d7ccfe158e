// Float fit: the pose from dots that were measured where the code has them: what `refine_pose`
// does, for dots in vectors and a plane in single precision. differs: the paper stops at eq. 12.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// Improves the plane, from dots at most `limit` (spacings^2) off at first and four deviations in
/// the end. False, when the dots do not determine it. Sets all of `fit`.
bool fit_plane(const Kernels& kernels, const MeasuredDots& dots, int reach_px, float limit,
               float displacement, FloatPlane& plane, PoseFit& fit);

}  // namespace dotpose::core
