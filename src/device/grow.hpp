// Grow: extends the first estimate of the grid to all dots, without perspective or lens. Paper
// section II-B.3. differs: eq. 6 continues with median lengths between neighbours. Here a
// least-squares fit to the dots within reach, with displacements as noise, gives all terms, and the
// reach grows from round to round.
#pragma once

#include "core/stages.hpp"
#include "dotpose/options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Sets the map from the image to the grid. Errors: no_grid if the dots are not on a grid,
/// no_displacement if all dots are on intersections. A camera with a tilt of more than a few
/// degrees, or a lens that bends the grid by more than a third of a spacing, needs `refine_grid`.
Status grow_grid(std::span<const Dot> dots, const LatticeOptions& options, Vec image_centre_q8,
                 const Lattice& first, PlaneFromImage& grid_from_image);

}  // namespace dotpose::core
