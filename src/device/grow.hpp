// Grow: extends the grid from its first estimate to the last dot, without perspective or lens.
// Paper section II-B.3. differs: eq. 6 continues with median lengths between neighbours; here a
// least-squares fit to the dots within reach, which treats displacements as noise, gives all terms
// at once, and the reach grows from there.
#pragma once

#include "core/stages.hpp"
#include "dotpose/options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Sets the map from the image to the grid. Errors: no_grid if the dots do not lie on one,
/// no_displacement if all lie on its intersections. A camera tilted by more than some degrees, or a
/// lens that bends the grid by more than a third of a spacing, needs `refine_grid`.
Status grow_grid(std::span<const Dot> dots, const LatticeOptions& options, Vec image_centre_q8,
                 const Lattice& first, PlaneFromImage& grid_from_image);

}  // namespace dotpose::core
