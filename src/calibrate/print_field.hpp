// Fields of a print: contiguous regions of the code in a scan, with their tiles.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/print_dots.hpp"
#include "calibrate/print_tiles.hpp"

namespace dotpose::calibrate {

/// One region of the code in the scan, with a map for each tile that shows the region.
struct Field {
    Code code;
    std::vector<std::optional<LocatedTile>> tiles;  ///< indexed by tile number
    double paper = 0;                               ///< median grey level of the paper
};

/// Joins neighbouring tiles with consistent maps into fields. The field with the most tiles comes
/// first.
std::vector<Field> join_tiles(const LocatedTiles& tiles);

}  // namespace dotpose::calibrate
