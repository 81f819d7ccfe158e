// Grid: the cells of a frame, with a quasi-probability for each bit (paper, section II-B.4 and
// figure 8).
#pragma once

#include <cstddef>
#include <span>

#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Maximum number of cells along each axis of a grid.
inline constexpr int kMaxGridSide = 256;

/// The paper's matrices P^(x) and P^(y). They cover the columns [i0, i0 + columns) and the rows
/// [j0, j0 + rows).
struct Grid {
    std::span<GridCell> storage;
    int side = 0;  ///< `storage` has room for side * side cells
    int i0 = 0;
    int j0 = 0;
    int columns = 0;
    int rows = 0;

    GridCell& at(int i, int j) const {
        return storage[static_cast<std::size_t>((j - j0) * columns + (i - i0))];
    }
    bool contains(int i, int j) const {
        return i >= i0 && j >= j0 && i < i0 + columns && j < j0 + rows;
    }
};

}  // namespace dotpose::core
