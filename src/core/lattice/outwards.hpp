// Outwards: finds the plane of the grid from the dots of a patch. Two plane waves through the dots
// near the middle provide a first plane. The plane is then fitted to more and more dots, with
// perspective once the reach exceeds four spacings. Paper sections II-B.2 and II-B.3.
#pragma once

#include "core/kernels/kernels.hpp"
#include "core/math/float_plane.hpp"

namespace dotpose::core {

/// The grid of a patch, and its agreement with the dots.
struct PatchGrid {
    FloatPlane grid_from_image;  ///< relative to the origin of the coordinates of the dots
    float displacement = 0;      ///< root mean square displacement of the dots, in spacings
    /// Variance of the offset of a dot from the nearest of the four places of its cell, per axis,
    /// in spacings^2.
    float variance = 0;
    /// Agreement of the dots with the grid: the sum of max_off^2 - offset^2 over the dots that are
    /// within max_off of a place of their cell, in spacings^2. Comparable between grids of the same
    /// dots.
    float agreement = 0;
};

/// Parameters of the search for the grid of a patch, estimated from the dots. The search begins at
/// the origin of the coordinates of the dots.
struct PatchView {
    float spacing_px = 0;  ///< approximate spacing, in px of the image
    /// Maximum distance of a dot from the origin along either axis, in px of the image.
    float full_reach_px = 0;
    /// Approximate number of dots near the origin from which the waves are computed, at most 64.
    float central_dots = 30;
    int min_dots = 40;  ///< minimum number of dots in the patch
    /// True if the cells may be any parallelograms, because a rolling shutter may shear and stretch
    /// the image. If false, the cells must be about square.
    bool is_skewed = false;
};

/// Returns the view of a patch that is completely covered by dots.
PatchView whole_view(const Patch& patch);

/// Moves the origin of the coordinates of the dots to the densest part of the patch. Intended for a
/// patch that is only partly covered by the pattern. The new origin is the dot with the smallest
/// distance to its 20th nearest neighbour, in a sample of the dots, rounded down to whole px. Sets
/// `view`, and sets `from_middle_px` to the new origin relative to the middle of the patch. Returns
/// false if there are fewer than kMinDots dots.
bool move_origin_to_densest(Patch& patch, PatchView& view, FloatVec& from_middle_px);

/// Finds the grid. Returns false if there are fewer than `view.min_dots` dots, if the dots do not
/// form a grid, or if the dots are not displaced from the intersections.
bool find_grid(const Kernels& kernels, const Patch& patch, const PatchView& view, PatchGrid& grid);

}  // namespace dotpose::core
