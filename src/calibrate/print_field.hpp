// Print fields: contiguous regions of the code in a scan, and where they lie.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/print_dots.hpp"
#include "calibrate/print_tiles.hpp"

namespace dotpose::calibrate {

/// One region of the code in the scan, and its place in each tile that shows it.
struct Field {
    Code code;
    std::vector<std::optional<LocatedTile>> tiles;  ///< by number
    double paper = 0;                               ///< median grey level of the paper
};

/// Joins tiles that continue each other to fields, those with the most tiles first.
std::vector<Field> join_tiles(const LocatedTiles& tiles);

}  // namespace dotpose::calibrate
