// Collects all cells of one field.
#pragma once

#include <vector>

#include "calibrate/print_field.hpp"

namespace dotpose::calibrate {

/// Rectangular grid of the cells of a field.
struct CellGrid {
    Cell origin;
    int columns = 0;
    int rows = 0;
    std::vector<SeenCell> cells;  ///< row by row; has_dot is false for cells that were not measured

    const SeenCell& at(int i, int j) const {
        return cells[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(i)];
    }
};

/// Measures all cells of a field, and returns them as a grid. Outer columns and rows that do not
/// belong to the field are removed. If no cells remain, the grid has no columns.
CellGrid collect_cells(const ImageView& scan, const Tiling& tiling, const Field& field);

}  // namespace dotpose::calibrate
