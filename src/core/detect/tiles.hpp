// Tiles: measures the mean level of each tile and the level of its darkest pair of adjacent pixels.
// The thresholds are computed from these two levels.
#pragma once

#include <span>

#include "core/detect/adaptive_threshold.hpp"

namespace dotpose::core {

/// Measures the tiles of a band, using only every fourth row. All rows of the band must be stored.
void measure_tiles(int band, const AdaptiveThreshold& threshold, std::span<Tile> tiles);

}  // namespace dotpose::core
