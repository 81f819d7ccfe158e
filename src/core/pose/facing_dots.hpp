// Facing dots: neighbours that are displaced towards each other. Blurred and large, they nearly
// touch, and each draws the centre of the other to itself. In the pose this cancels out, but the
// dots seem to scatter more than they do. differs: the paper does not state how well a pose is
// known.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/patch_memory.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// Estimates from the residuals how far facing dots, listed row by row, are drawn together, and
/// moves them apart by that. Returns false if they are not, as far as the fit tells.
bool take_pull(const FloatPlane& plane, const PoseFit& fit, MeasuredDots& dots);

}  // namespace dotpose::core
