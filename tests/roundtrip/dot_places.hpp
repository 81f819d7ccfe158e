/// Measures the positions of the dots on a rendered sheet.
#pragma once

#include "dotpose/tools/print.hpp"
#include "rendered_page.hpp"

namespace dotpose::roundtrip {

struct DotErrors {
    int dots = 0;
    int missing = 0;  ///< number of dots without any ink
    /// Number of dots that are closer to the position of another symbol than to that of the correct
    /// symbol.
    int wrong_symbols = 0;
    /// Mean and maximum distance between a dot's centroid and its nominal position, after
    /// subtracting the mean offset from all centroids.
    double mean_um = 0;
    double largest_um = 0;
    double offset_x_um = 0;
    double offset_y_um = 0;
};

/// Compares every dot with its nominal position. `dpi` is the resolution of `page`.
DotErrors measure_dots(const GreyPage& page, const Sheet& sheet, double dpi);

}  // namespace dotpose::roundtrip
