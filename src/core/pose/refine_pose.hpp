// Refine: the pose from all dots. Once the position is known, so is where every dot was printed,
// displacement included; the pose is the map of least squares from the dots' centres to these
// places. differs: the paper stops at eq. 12, whose grid carries the displacements as noise. In
// floating point, of single precision.
#pragma once

#include "core/fit/plane_normal_float.hpp"
#include "core/pose/observations.hpp"
#include "core/pose/posterior.hpp"
#include "core/stages.hpp"
#include "dotpose/fix.hpp"

namespace dotpose::core {

/// How the dots determine the pose.
struct PoseFit {
    int reach_px = 1;         ///< the unit of length in the image
    int dots = 0;             ///< those used; others lay too far off
    float variance = 0;       ///< of one coordinate of one dot, spacings^2
    float squares = 0;        ///< squared residuals after the last step, of all dots used
    float displacement = 0;   ///< of the typical dot from its intersection, spacings
    PlaneNormalFloat normal;  ///< of the parameters of `jacobian`, decomposed
    std::array<Parameters, kPoseParameters> covariance;  ///< of the whitened parameters
    Surface surface = Surface::even;
    /// What an uneven sheet adds to the covariance of x, y and theta.
    std::array<std::array<float, 3>, 3> uneven{};
};

/// Solves the normal equations of `fit` for the step to the plane of least squares, and shrinks the
/// further terms to their posterior means. `distortions` are these terms of the plane so far,
/// `unit` is its scale. Sets `moved`, the size of the step in squared deviations, and all of `fit`
/// except the displacement. Returns false if the dots do not determine the plane.
bool solve(const Parameters& distortions, float unit, PoseFit& fit, Parameters& step, float& moved);

/// Improves the pose. Dots that are farther off than most are left out; terms that a camera
/// straight above flat paper would not need are shrunk (pose/posterior), as each costs accuracy.
/// Returns false, with the pose as it was, if the dots do not determine it.
bool refine_pose(const Observations& observations, PlaneFromImage& pattern_from_image,
                 PoseFit& fit);

}  // namespace dotpose::core
