// What the cells of a field say about the print.
#pragma once

#include <optional>

#include "calibrate/print_cells.hpp"
#include "dotpose/check_print.hpp"

namespace dotpose::calibrate {

/// All that is known of a field.
struct Measuring {
    const ImageView& scan;
    const Field& field;
    const CellGrid& grid;
    std::optional<Resolution> resolution;
    double ink_reflectance = 0;
};

/// Fills `result` apart from its pattern. False if fewer than `least_dots` dots read right.
bool measure_field(const Measuring& measuring, std::size_t least_dots, PrintField& result);

}  // namespace dotpose::calibrate
