// Outwards: from the dots of a patch to the plane of their grid: waves through the dots near the
// middle, then planes fitted to more and more of them, with perspective as it shows. Paper sections
// II-B.2 and II-B.3.
#pragma once

#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// A grid and how well the dots of the patch sit on it.
struct PatchGrid {
    FloatPlane grid_from_image;  ///< counted from the middle of the patch
    float displacement = 0;      ///< of the typical dot, spacings
    float variance = 0;  ///< of a dot from the nearest of the four places of its cell, per axis
};

/// False if the dots lie on no grid, or are not displaced.
bool find_grid(const Kernels& kernels, const Patch& patch, PatchGrid& grid);

}  // namespace dotpose::core
