// Tiles: the mean and the darkest pixel of each, from which the light is known.
#pragma once

#include <span>

#include "core/stages.hpp"

namespace dotpose::core {

/// Measures the tiles of a band whose rows are kept.
void measure_tiles(int band, const Light& light, std::span<Tile> tiles);

}  // namespace dotpose::core
