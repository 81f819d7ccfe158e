// Window: finds the square of cells with the highest total quality (paper, section II-B.5).
#pragma once

#include "core/decode/grid.hpp"

namespace dotpose::core {

/// Returns the `side` x `side` window with the highest total quality (see `quality` in
/// decode/likelihood.hpp). If the grid has fewer than `side` columns (or rows), the window contains
/// all columns (or rows).
GridRegion choose_window(const Grid& grid, int side);

/// Returns the mean quality of the cells in a region, in units of 1/256 of the maximum quality. The
/// result is 256 if every cell has a dot exactly at one of its four dot positions.
int mean_quality_q8(const Grid& grid, const GridRegion& region);

}  // namespace dotpose::core
