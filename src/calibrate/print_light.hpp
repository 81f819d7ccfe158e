// How dark dots are to be expected across a page: light and focus change slowly over it.
#pragma once

#include <vector>

#include "calibrate/print_field.hpp"

namespace dotpose::calibrate {

/// For every tile, the darkness of a dot by a smooth surface through those of the tiles with maps.
/// A tile in which many dots are missing does not bend it.
std::vector<double> smooth_strengths(const Field& field, const Tiling& tiling);

}  // namespace dotpose::calibrate
