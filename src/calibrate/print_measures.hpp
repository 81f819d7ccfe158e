// What the cells of a field say about the print.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/print_cells.hpp"
#include "calibrate/print_fit.hpp"
#include "dotpose/tools/check_print.hpp"

namespace dotpose::calibrate {

/// All that is known of a field.
struct Measuring {
    const ImageView& scan;
    const Field& field;
    const CellGrid& grid;
    std::optional<Resolution> resolution;  ///< of a scan; none for photos
    double ink_reflectance = 0;
};

/// The dots that read right: nominal places from the first cell on, and places in px.
std::vector<Match> matches_of(const CellGrid& grid, const Field& field, const Pattern& pattern);

/// Fills `result` apart from its pattern. False if fewer than `least_dots` dots read right.
bool measure_field(const Measuring& measuring, std::size_t least_dots, PrintField& result);

}  // namespace dotpose::calibrate
