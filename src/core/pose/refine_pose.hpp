// Refine: the pose from all dots. Once the position is known, so is where every dot was printed,
// its displacement included; the least-squares map from the dots' centres to these places is the
// pose. differs: the paper stops at eq. 12, whose grid carries the displacements as noise. In
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
    int dots = 0;             ///< used; others lay too far off
    float variance = 0;       ///< of one coordinate of one dot, spacings^2
    float displacement = 0;   ///< of the typical dot from its intersection, spacings
    PlaneNormalFloat normal;  ///< of the parameters of `jacobian`, decomposed
    std::array<Parameters, kPoseParameters> covariance;  ///< of the parameters whitened
    /// Whether a glance found nothing that neighbouring dots are off in common.
    bool is_plainly_even = false;
    Surface surface = Surface::even;
    /// Of x, y and theta, besides what each dot's scatter makes of them.
    std::array<std::array<float, 3>, 3> uneven{};
};

/// The step to the plane of least squares, by the normal equations of `fit`, with as much of the
/// further terms as is to be believed. `distortions`: what the plane has of them; `unit`: its
/// scale. `moved`: by how much it differs, in squared deviations. Sets the rest of `fit` but the
/// displacement.
bool solve(const Parameters& distortions, float unit, PoseFit& fit, Parameters& step, float& moved);

/// Improves the pose; dots farther off than most are left out, and terms that a plain camera would
/// not need are kept as far as they are to be believed (pose/posterior): each costs accuracy.
/// Returns false, with the pose as it was, when the dots do not determine it.
bool refine_pose(const Observations& observations, PlaneFromImage& pattern_from_image,
                 PoseFit& fit);

}  // namespace dotpose::core
