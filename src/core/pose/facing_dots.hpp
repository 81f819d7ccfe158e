// Facing dots: corrects the bias of adjacent dots that are displaced towards each other. If facing
// dots are large or blurred, each dot shifts the centroid of the other dot towards itself. The two
// shifts cancel in the pose, but they increase the residuals and therefore the estimated
// covariance. The paper does not need this correction, because it does not estimate a covariance.
#pragma once

#include "core/math/float_plane.hpp"
#include "core/patch_memory.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// Estimates the common bias of facing dots from their residuals, and subtracts the bias from the
/// dot centres. `dots` must be sorted by row, and by column within each row. If the bias is not
/// significant, changes nothing and returns false.
bool correct_neighbour_bias(const FloatPlane& plane, const PoseFit& fit, MeasuredDots& dots);

}  // namespace dotpose::core
