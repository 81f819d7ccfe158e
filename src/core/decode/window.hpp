// Window: the square of cells that is read most clearly. Paper section II-B.5, with 8 x 8 cells.
#pragma once

#include "core/stages.hpp"

namespace dotpose::core {

/// Returns the square of `side` x `side` cells with the largest sum of qualities; less than that
/// where the grid is narrower or lower.
Region choose_window(const Grid& grid, int side);

/// Returns the mean quality of a region's cells, in 1/256: 256 where every dot is exactly where a
/// symbol has it.
int mean_quality_q8(const Grid& grid, const Region& region);

}  // namespace dotpose::core
