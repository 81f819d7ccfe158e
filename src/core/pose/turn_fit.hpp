// Turn fit: fits the rotation of the scene during the readout of a rolling shutter to the dots,
// together with the plane.
#pragma once

#include <array>

#include "core/kernels/kernels.hpp"
#include "core/math/readout_turn.hpp"
#include "core/pose/refine_pose.hpp"

namespace dotpose::core {

/// Result of `fit_turn`.
struct TurnFit {
    ReadoutTurn turn;    ///< fitted rotation
    float variance = 0;  ///< variance of `turn.rad_per_row`
    /// Contribution of the uncertainty of the rotation to the covariance of x and y (in spacings)
    /// and theta at the reference point.
    std::array<std::array<float, 3>, 3> pose_covariance{};
};

/// Fits rotation and drift by least squares, moves the dots to the fitted rotation, and fits the
/// plane to the moved dots. `turn` is the rotation that was removed from the image in which the
/// dots were measured. The drift is near that of a camera straight above the paper, and is
/// determined by the curvature that it causes together with the rotation. Returns false if the dots
/// do not determine the rotation.
bool fit_turn(const Kernels& kernels, const ReadoutTurn& turn, FloatVec reference_px,
              MeasuredDots& dots, FloatPlane& plane, PoseFit& fit, TurnFit& result);

}  // namespace dotpose::core
