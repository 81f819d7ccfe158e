// Computes the measurements of a print from the cells of a field.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/print_cells.hpp"
#include "calibrate/print_fit.hpp"
#include "dotpose/tools/check_print.hpp"

namespace dotpose::calibrate {

struct Measuring {
    const ImageView& scan;
    const Field& field;
    const CellGrid& grid;
    std::optional<Resolution> resolution;  ///< resolution of a scan, or empty for photos
    double ink_reflectance = 0;
};

/// Returns, for each correctly read dot, its nominal position in mm relative to the first cell of
/// the grid, and its measured position in px.
std::vector<Match> matches_of(const CellGrid& grid, const Field& field, const Pattern& pattern);

/// Measures a field and sets all members of `result` except `pattern`, `is_patch` and `sheet`.
/// Returns false if fewer than `min_dots` dots were read correctly.
bool measure_field(const Measuring& measuring, std::size_t min_dots, PrintField& result);

}  // namespace dotpose::calibrate
