// Tiles: measures the mean and the darkest pixels of each tile, from which the thresholds are
// computed.
#pragma once

#include <span>

#include "core/detect/adaptive_threshold.hpp"

namespace dotpose::core {

/// Measures the tiles of a band from every fourth row. All rows of the band must be stored.
void measure_tiles(int band, const AdaptiveThreshold& threshold, std::span<Tile> tiles);

}  // namespace dotpose::core
