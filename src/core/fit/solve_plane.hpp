// Solve plane: computes one Gauss-Newton step towards the least-squares plane. Shrinks the
// distortion terms according to the probability that distortion is present.
#pragma once

#include <array>

#include "core/fit/plane_normal.hpp"
#include "dotpose/fix.hpp"

namespace dotpose::core {

/// Result of a fit: the number of dots, their residuals, and the uncertainty of the parameters.
struct PoseFit {
    int reach_px = 1;        ///< unit of length in the image, in px
    int dots = 0;            ///< number of inliers
    float variance = 0;      ///< noise variance of a dot along one axis, in spacings^2
    float squares = 0;       ///< sum of the squared residuals of all inliers after the last step
    float displacement = 0;  ///< distance of a typical dot from its intersection, in spacings
    PlaneNormal normal;      ///< normal equations of the parameters of `jacobian`, decomposed
    std::array<Parameters, kPoseParameters> covariance;  ///< covariance of the whitened parameters
    Surface surface = Surface::even;
    /// Contribution of an uneven sheet to the covariance of x, y and theta.
    std::array<std::array<float, 3>, 3> uneven{};
};

/// Returns the plane from which a step is computed. The `at_centre` of this plane is 0, because
/// `at_centre` may need more bits than a float has.
ScaledPlane scaled_from_centre(const PlaneFromImage& plane, int reach_px);
/// Returns the plane after a step. `scaled` is the result of `scaled_from_centre` for the plane.
PlaneFromImage stepped(const PlaneFromImage& plane, const ScaledPlane& scaled,
                       const Parameters& step);

/// Solves the normal equations of `fit` for the step towards the least-squares plane, and shrinks
/// the distortion terms to their posterior means. `distortions` contains the distortion terms of
/// the current plane, and `unit` is the scale of the current plane. Sets the number of dots, the
/// variance, the squares and the covariance of `fit`. Sets `moved` to the squared length of the
/// step in units of the standard deviation of the pose. Returns false if the dots do not determine
/// the plane.
bool solve(const Parameters& distortions, float unit, PoseFit& fit, Parameters& step, float& moved);

}  // namespace dotpose::core
