// Refine: fits the pose to all dots in view once the position is known, in single precision. The
// position determines the printed place of each dot, including its displacement, and the pose is
// the least-squares map from the measured centres to these places. The paper computes the pose from
// the grid (eq. 10-12) instead, to which the displacements add noise.
#pragma once

#include "core/fit/solve_plane.hpp"
#include "core/pose/observations.hpp"
#include "dotpose/geometry.hpp"

namespace dotpose::core {

/// Improves the pose, and rejects outliers. Each fitted distortion term adds noise to the pose. For
/// a camera that looks straight at flat paper, this noise is avoidable, because the true value of
/// the term is 0. The terms are therefore shrunk to their posterior means (fit/posterior). Returns
/// false if the dots do not determine the pose. `pattern_from_image` is then the result of the last
/// successful iteration.
bool refine_pose(const Observations& observations, PlaneFromImage& pattern_from_image,
                 PoseFit& fit);

}  // namespace dotpose::core
