// Outwards: from the dots of a patch to the plane of their grid: waves through the dots near the
// middle, then planes fitted to more and more of them, with perspective as it shows. Paper sections
// II-B.2 and II-B.3.
#pragma once

#include "core/kernels/kernels.hpp"
#include "core/math/float_plane.hpp"

namespace dotpose::core {

/// A grid and how well the dots of the patch sit on it.
struct PatchGrid {
    FloatPlane grid_from_image;  ///< counted from the middle of the patch
    float displacement = 0;      ///< of the typical dot, spacings
    float variance = 0;  ///< of a dot from the nearest of the four places of its cell, per axis
};

/// What is known of a patch's dots before: the grid is looked for from where they are counted.
struct PatchView {
    float spacing_px = 0;     ///< about, of the image
    float full_reach_px = 0;  ///< no dot is farther along an axis
    /// Dots near the middle whose waves are looked at: about so many, and at most 64.
    float central_dots = 30;
};

/// Of a patch that is full of dots.
PatchView whole_view(const Patch& patch);

/// Counts the dots of a patch that shows the pattern in a part only from the one that has the
/// others nearest around it. False if there are too few. `from_middle_px`: how far off the patch's
/// middle it lies.
bool count_from_densest(Patch& patch, PatchView& view, FloatVec& from_middle_px);

/// False if the dots lie on no grid, or are not displaced.
bool find_grid(const Kernels& kernels, const Patch& patch, const PatchView& view, PatchGrid& grid);

}  // namespace dotpose::core
