// Refine pose: fits the pose to all dots in view, in single precision, once the place in the code
// is known. The place determines the printed position of each dot, including its displacement. The
// pose is the least-squares map from the measured centres to these printed positions. Unlike the
// paper, which computes the pose from the grid (paper, equations 10-12), this fit is not affected
// by the noise that displacements add to the grid.
#pragma once

#include "core/fit/solve_plane.hpp"
#include "core/pose/observations.hpp"
#include "dotpose/geometry.hpp"

namespace dotpose::core {

/// Improves the pose by least squares, and rejects outliers. Shrinks the distortion terms towards
/// 0, to their posterior means (fit/posterior), because fitting a term whose true value is 0 only
/// adds noise to the pose. Returns false if the dots do not determine the pose. In this case,
/// `pattern_from_image` contains the result of the last successful iteration, if any.
bool refine_pose(const Observations& observations, PlaneFromImage& pattern_from_image,
                 PoseFit& fit);

}  // namespace dotpose::core
