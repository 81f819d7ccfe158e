// Print light: the expected darkness of dots across a page, on which light and focus change slowly.
#pragma once

#include <vector>

#include "calibrate/print_field.hpp"

namespace dotpose::calibrate {

/// Returns for every tile the darkness of a dot, by a smooth surface through those of the tiles
/// with maps. Tiles in which many dots are missing do not bend it.
std::vector<double> smooth_strengths(const Field& field, const Tiling& tiling);

}  // namespace dotpose::calibrate
