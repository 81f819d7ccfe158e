// Refine: fits the pose to all dots in view, at a known position. The position determines the
// printed place of each dot, including its displacement. The pose is the least-squares map from the
// measured centres to these places. Uses single precision. The paper computes the pose from the
// grid (eq. 10-12), to which the displacements add noise. This fit includes the displacements in
// its model.
#pragma once

#include "core/fit/solve_plane.hpp"
#include "core/pose/observations.hpp"
#include "dotpose/geometry.hpp"

namespace dotpose::core {

/// Improves the pose, and rejects outliers. Shrinks the distortion terms to their posterior means
/// (fit/posterior), because each fitted term adds noise to the pose. For a camera that looks
/// straight at flat paper, the true terms are 0. Returns false if the dots do not determine the
/// pose.
bool refine_pose(const Observations& observations, PlaneFromImage& pattern_from_image,
                 PoseFit& fit);

}  // namespace dotpose::core
