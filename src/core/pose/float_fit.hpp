// Float fit: the pose from dots that were measured where the code has them. Does what `refine_pose`
// does, in vectors and single precision. differs: the paper stops at eq. 12.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// Improves the plane. Dots count that are at most `limit` (spacings^2) off in the first round, and
/// four deviations in the last. Sets all of `fit`. Returns false if the dots do not determine the
/// plane.
bool fit_plane(const Kernels& kernels, const MeasuredDots& dots, int reach_px, float limit,
               float displacement, FloatPlane& plane, PoseFit& fit);

}  // namespace dotpose::core
