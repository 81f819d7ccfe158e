// Outwards: finds the grid in a patch, starting near the middle of the patch (paper, sections
// II-B.2 and II-B.3). The search computes a first plane from two plane waves that fit the central
// dots. It then fits the plane to more and more dots (lattice/grid_fit).
#pragma once

#include "core/kernels/kernels.hpp"
#include "core/lattice/grid_fit.hpp"

namespace dotpose::core {

/// Parameters of the grid search in a patch, estimated from the dots. The search begins at the
/// origin of the dot coordinates.
struct PatchView {
    float spacing_px = 0;  ///< approximate spacing, in image pixels
    /// Upper bound on the distance of a dot from the origin, along each axis, in image pixels.
    float full_reach_px = 0;
    /// Approximate number of central dots, at most 64. The waves are computed from these dots.
    float central_dots = 30;
    int min_dots = 40;  ///< minimum number of dots in the patch
    /// True if the cells may be arbitrary parallelograms, because a rolling shutter shears and
    /// stretches the image. Otherwise, the cells must be approximately square.
    bool is_skewed = false;
};

/// Returns the search parameters for a patch that is completely covered with dots.
PatchView whole_view(const Patch& patch);

/// Moves the origin of the dot coordinates to the densest part of a patch that the pattern covers
/// only partly. The density around a dot is measured by the distance to its 20th nearest neighbour.
/// Sets `view`, and sets `from_middle_px` to the new origin relative to the middle of the patch, in
/// whole px. Returns false and changes nothing if there are fewer than kMinDots dots.
bool move_origin_to_densest(Patch& patch, PatchView& view, FloatVec& from_middle_px);

/// Finds the grid. Returns false if there are fewer than `view.min_dots` dots, if the dots do not
/// form a grid, or if they are not displaced from the intersections. In these cases, `grid` is
/// unspecified.
bool find_grid(const Kernels& kernels, const Patch& patch, const PatchView& view, PatchGrid& grid);

}  // namespace dotpose::core
