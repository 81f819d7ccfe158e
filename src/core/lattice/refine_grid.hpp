// Refine grid: extends the first grid estimate to all dots, with perspective and lens distortion
// (paper, section II-B.3, equation 6).
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/status.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Computes the map from the image to the grid, including perspective and, if it is significant,
/// the lens distortion that remains in the dot centres. `first` is the first grid estimate. Returns
/// no_grid if too few dots are near the intersections, if the dots are scattered like random
/// points, or if the grid axes fail `is_nearly_square`. Returns no_displacement for a plain dot
/// grid, whose dots are on the intersections.
Status refine_grid(std::span<const DetectedDot> dots, const LatticeOptions& options,
                   FixedVec image_centre_q8, const Lattice& first, PlaneFromImage& grid_from_image);

}  // namespace dotpose::core
