/// Where the dots of a rendered sheet really are.
#pragma once

#include "dotpose/tools/print.hpp"
#include "rendered_page.hpp"

namespace dotpose::roundtrip {

struct DotErrors {
    int dots = 0;
    int missing = 0;        ///< places without any ink
    int wrong_symbols = 0;  ///< dots nearer to another symbol's place than to that of `symbol_at`
    double mean_um = 0;     ///< distance of the centroid from its place, after one constant offset
    double largest_um = 0;
    double offset_x_um = 0;
    double offset_y_um = 0;
};

/// Compares every dot with its nominal place. `dpi` is the resolution of `page`.
DotErrors measure_dots(const GreyPage& page, const Sheet& sheet, double dpi);

}  // namespace dotpose::roundtrip
