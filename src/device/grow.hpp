// Grow: extends the first estimate of the grid to all dots, without perspective or lens distortion.
// Paper section II-B.3. Differs: the paper uses eq. 6 and then the median lengths between
// neighbours. This implementation estimates all terms with a least-squares fit to the dots within
// reach. The fit treats displacements as noise. The reach grows from fit to fit.
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/status.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Sets the map from the image to the grid. Errors: no_grid if the dots are not on a grid,
/// no_displacement if all dots are on intersections. A camera with a tilt of more than a few
/// degrees, or a lens that bends the grid by more than a third of a spacing, needs `refine_grid`.
Status grow_grid(std::span<const DetectedDot> dots, const LatticeOptions& options,
                 FixedVec image_centre_q8, const Lattice& first, PlaneFromImage& grid_from_image);

}  // namespace dotpose::core
