// Grid: the matrices of quasi-probabilities of the bits. Paper section II-B.4, Fig. 8.
#pragma once

#include <cstddef>
#include <span>

#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Maximum number of cells along each axis of a grid, in workspaces of any size.
inline constexpr int kMaxGridSide = 256;

/// The matrices P^(x), P^(y) over the cells [i0, i0 + columns) x [j0, j0 + rows).
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
