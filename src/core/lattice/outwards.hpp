// Outwards: finds the plane of the grid from the dots of a patch. Waves through the dots near the
// middle give a first plane; then planes are fitted to more and more dots, with perspective once it
// shows. Paper sections II-B.2 and II-B.3.
#pragma once

#include "core/kernels/kernels.hpp"
#include "core/math/float_plane.hpp"

namespace dotpose::core {

/// A grid, and how well the dots of the patch agree with it.
struct PatchGrid {
    FloatPlane grid_from_image;  ///< counted from the middle of the patch
    float displacement = 0;      ///< of a typical dot, spacings
    float variance = 0;  ///< of a dot from the nearest of the four places of its cell, per axis,
                         ///< spacings^2
};

/// What is known of a patch's dots before the search; the grid is searched around the point that
/// they are counted from.
struct PatchView {
    float spacing_px = 0;     ///< approximate spacing, in px of the image
    float full_reach_px = 0;  ///< greatest distance of a dot along an axis, in px of the image
    /// Approximate number of dots near the middle in which waves are searched; at most 64.
    float central_dots = 30;
};

/// Returns the view of a patch that is full of dots.
PatchView whole_view(const Patch& patch);

/// For a patch that the pattern covers only in part: counts its dots from the one whose neighbours
/// are nearest. `from_middle_px` is set to its distance from the patch's middle. Returns false if
/// there are too few dots.
bool count_from_densest(Patch& patch, PatchView& view, FloatVec& from_middle_px);

/// Finds the grid. Returns false if the dots lie on none, or are not displaced.
bool find_grid(const Kernels& kernels, const Patch& patch, const PatchView& view, PatchGrid& grid);

}  // namespace dotpose::core
