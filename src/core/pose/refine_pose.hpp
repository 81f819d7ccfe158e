// Refine: the pose from all dots. Once the position is known, the printed place of every dot is
// known, including its displacement. The pose is the least-squares map from the centres of the dots
// to these places. differs: the paper stops at eq. 12, whose grid has the displacements as noise.
// Single precision.
#pragma once

#include "core/fit/solve_plane.hpp"
#include "core/pose/observations.hpp"
#include "dotpose/geometry.hpp"

namespace dotpose::core {

/// Improves the pose. Outliers are rejected. Distortion terms, which a camera straight above flat
/// paper does not need, are shrunk to their posterior means (fit/posterior), because each term
/// costs accuracy. Returns false, without a change, if the dots do not determine the pose.
bool refine_pose(const Observations& observations, PlaneFromImage& pattern_from_image,
                 PoseFit& fit);

}  // namespace dotpose::core
