// Tiles: the mean and the darkest pixels of each tile, from which the light is measured.
#pragma once

#include <span>

#include "core/stages.hpp"

namespace dotpose::core {

/// Measures the tiles of a band whose rows are kept.
void measure_tiles(int band, const Light& light, std::span<Tile> tiles);

}  // namespace dotpose::core
