// Window: finds the square of cells with the highest sum of qualities. Paper section II-B.5, with 8
// x 8 cells.
#pragma once

#include "core/decode/grid.hpp"

namespace dotpose::core {

/// Returns the square of `side` x `side` cells with the highest sum of qualities. If the grid has
/// fewer than `side` columns (or rows), the result contains all its columns (or rows).
GridRegion choose_window(const Grid& grid, int side);

/// Returns the mean quality of the cells of a region, in 1/256. The mean is 256 if every dot is
/// exactly at the place of a symbol.
int mean_quality_q8(const Grid& grid, const GridRegion& region);

}  // namespace dotpose::core
