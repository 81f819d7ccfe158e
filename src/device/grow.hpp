// Grow: extends the first grid estimate to all dots (paper, section II-B.3). Assumes no perspective
// and no lens distortion. The paper first refines the origin (equation 6), and then sets the
// lengths of the grid vectors to the median distances between neighbouring dots. This stage instead
// fits the origin and the vectors together, by least squares, and treats the displacements of the
// dots as noise. The first fit uses the dots near the origin, and later fits use larger areas.
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/status.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Sets the map from the image to the grid. Returns no_grid if the dots are not on a grid, and
/// no_displacement if all dots are on intersections. If the camera is tilted by more than a few
/// degrees, or if lens distortion moves dots by more than a third of a spacing, use `refine_grid`
/// instead.
Status grow_grid(std::span<const DetectedDot> dots, const LatticeOptions& options,
                 FixedVec image_centre_q8, const Lattice& first, PlaneFromImage& grid_from_image);

}  // namespace dotpose::core
