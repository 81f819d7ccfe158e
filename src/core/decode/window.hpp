// Window: finds the square of cells with the highest total quality (paper, section II-B.5).
#pragma once

#include "core/decode/grid.hpp"

namespace dotpose::core {

/// Returns the `side` x `side` window with the highest total quality (see `quality` in
/// decode/likelihood.hpp). If the grid has fewer than `side` columns, the window contains all
/// columns. The same applies to rows.
GridRegion choose_window(const Grid& grid, int side);

/// Returns the mean quality of a region, in 1/256. The mean is 256 if every dot is exactly at one
/// of its four possible places.
int mean_quality_q8(const Grid& grid, const GridRegion& region);

}  // namespace dotpose::core
