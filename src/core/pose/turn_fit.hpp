// Turn fit: fits the rotation of the scene during the readout of a rolling shutter, together with
// the plane.
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
    /// Additional covariance of x, y (in spacings) and theta at the reference point, due to the
    /// uncertainty of the fitted rotation and drift.
    std::array<std::array<float, 3>, 3> pose_covariance{};
};

/// Fits rotation and drift by least squares, corrects the dots for the fitted rotation, and fits
/// the plane to the corrected dots. `turn` is the rotation that was removed from the image in which
/// the dots were measured. Two observations determine the drift (see ReadoutTurn): the curvature
/// that drift and rotation cause together, and the approximate drift that `drift_of` computes from
/// the plane. Returns false if the dots do not determine the rotation. In this case, `dots`,
/// `plane` and `fit` may have changed and must not be used.
bool fit_turn(const Kernels& kernels, const ReadoutTurn& turn, FloatVec reference_px,
              MeasuredDots& dots, FloatPlane& plane, PoseFit& fit, TurnFit& result);

/// Estimates, at a small fraction of the cost of `fit_turn`, how much of the residuals of a plane
/// fit a rotation explains. Returns explained / (dots * variance), where `explained` is the
/// decrease in the sum of the squared residuals, and `variance` is the remaining variance along one
/// axis. Only the drift and the axis of `turn` are used. The estimate is linear in the rotation,
/// and approximates the effects that the plane absorbs. Uses the dots whose squared residual is at
/// most `limit`, in spacings^2. Returns 0 if these dots do not determine the rotation.
float gain_of_turn(const ReadoutTurn& turn, float reach_px, const MeasuredDots& dots,
                   const FloatPlane& plane, float displacement, float limit);

}  // namespace dotpose::core
