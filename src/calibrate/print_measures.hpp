// Print measures: measurements of a print from the cells of a field.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/print_cells.hpp"
#include "calibrate/print_fit.hpp"
#include "dotpose/tools/check_print.hpp"

namespace dotpose::calibrate {

/// The inputs of the measurements of a field.
struct Measuring {
    const ImageView& scan;
    const Field& field;
    const CellGrid& grid;
    std::optional<Resolution> resolution;  ///< resolution of a scan; none for photos
    double ink_reflectance = 0;
};

/// Returns the dots that read right: nominal places from the first cell on, and seen places in px.
std::vector<Match> matches_of(const CellGrid& grid, const Field& field, const Pattern& pattern);

/// Measures a field: fills `result` except for its pattern. Returns false if fewer than
/// `least_dots` dots read right.
bool measure_field(const Measuring& measuring, std::size_t least_dots, PrintField& result);

}  // namespace dotpose::calibrate
