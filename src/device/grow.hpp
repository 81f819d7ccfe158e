// Grow: extends the first grid estimate to all dots (paper, section II-B.3). Assumes no perspective
// and no lens distortion. Unlike the paper, which uses eq. 6 and then median lengths between
// neighbours, this stage fits all terms by least squares. The fit treats displacements as noise. It
// starts near the origin and extends its reach from fit to fit.
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/status.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Sets the map from the image to the grid. Returns no_grid if the dots are not on a grid, and
/// no_displacement if all dots are on intersections. Use `refine_grid` if the camera is tilted by
/// more than a few degrees, or if the lens bends the grid by more than a third of a spacing.
Status grow_grid(std::span<const DetectedDot> dots, const LatticeOptions& options,
                 FixedVec image_centre_q8, const Lattice& first, PlaneFromImage& grid_from_image);

}  // namespace dotpose::core
