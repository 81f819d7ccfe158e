// Refine: fits the pose to all dots. Once the position is known, the printed place of every dot is
// known, including its displacement. The pose is the least-squares map from the centres of the dots
// to these places. Uses single precision. Differs: the paper stops at eq. 12 and fits a grid, in
// which the displacements are noise.
#pragma once

#include "core/fit/solve_plane.hpp"
#include "core/pose/observations.hpp"
#include "dotpose/geometry.hpp"

namespace dotpose::core {

/// Improves the pose and rejects outliers. Distortion terms are shrunk to their posterior means
/// (fit/posterior), because each term costs accuracy, and a camera straight above flat paper does
/// not need them. Returns false if the dots do not determine the pose.
bool refine_pose(const Observations& observations, PlaneFromImage& pattern_from_image,
                 PoseFit& fit);

}  // namespace dotpose::core
