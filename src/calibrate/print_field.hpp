// Fields: contiguous regions of the code in a scan, with all their cells.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/print_anchors.hpp"
#include "calibrate/print_dots.hpp"

namespace dotpose::calibrate {

/// One region of the code in the scan: which tiles show it, and where.
struct Field {
    Code code;
    std::vector<std::optional<LocalMap>> maps;  ///< for each tile
    double strength = 0;                        ///< darkness to be expected of a dot
    double paper = 0;                           ///< median grey level of the paper
};

/// Anchors that continue each other become one field each.
std::vector<Field> group_anchors(const std::vector<Anchor>& anchors, const Tiling& tiling);

/// Carries the grid from the anchored tiles on into their neighbours, as far as dots go on reading
/// right, and fits all maps to the dots. False if no dots bear the anchors out.
bool follow(const ImageView& scan, const Tiling& tiling, Field& field);

/// The cells of a field: a rectangle of the code, row by row.
struct CellGrid {
    Cell origin;
    int columns = 0;
    int rows = 0;
    std::vector<SeenCell> cells;  ///< those never looked at have no dot

    const SeenCell& at(int i, int j) const {
        return cells[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(i)];
    }
};

/// Measures all cells of a field. Outer columns and rows in which fewer than half of the cells read
/// right are not part of it. No columns if nothing is left.
CellGrid collect_cells(const ImageView& scan, const Tiling& tiling, const Field& field);

}  // namespace dotpose::calibrate
