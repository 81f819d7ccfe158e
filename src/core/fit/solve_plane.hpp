// Solve plane: computes one Gauss-Newton step towards the least-squares plane. Shrinks the
// distortion terms according to the probability that distortion is present.
#pragma once

#include <array>

#include "core/fit/plane_normal.hpp"
#include "dotpose/fix.hpp"

namespace dotpose::core {

/// Result of a plane fit: dots, residuals and parameter uncertainty.
struct PoseFit {
    int reach_px = 1;        ///< image length that corresponds to `ScaledPlane::scale()`, in px
    int dots = 0;            ///< number of inliers
    float variance = 0;      ///< noise variance of a dot along one axis, in spacings^2
    float squares = 0;       ///< sum of the squared residuals after the last step, in spacings^2
    float displacement = 0;  ///< typical distance of a dot from its intersection, in spacings
    PlaneNormal normal;      ///< factored normal equations (see `Parameters`)
    std::array<Parameters, kPoseParameters> covariance;  ///< covariance of the whitened parameters
    Surface surface = Surface::even;
    /// Covariance that the unevenness of the sheet adds to that of x, y and theta.
    std::array<std::array<float, 3>, 3> uneven{};
};

/// Converts a plane to single precision, as the starting point for a Gauss-Newton step. The pattern
/// point at the plane centre is set to 0, because a float cannot represent a large position
/// accurately.
ScaledPlane scaled_from_centre(const PlaneFromImage& plane, int reach_px);
/// Returns the plane after a step. `scaled` is the result of `scaled_from_centre(plane)`.
PlaneFromImage stepped(const PlaneFromImage& plane, const ScaledPlane& scaled,
                       const Parameters& step);

/// Solves the normal equations in `fit` for one step, and shrinks the distortion terms to their
/// posterior means. `distortions` contains the current distortion terms, and `unit` is
/// `ScaledPlane::scale()`. Sets `dots`, `variance`, `squares` and `covariance` in `fit`. Sets
/// `moved` to the squared length of the whitened step, in units of `fit.variance`. Returns false if
/// the dots do not determine the plane.
bool solve(const Parameters& distortions, float unit, PoseFit& fit, Parameters& step, float& moved);

}  // namespace dotpose::core
