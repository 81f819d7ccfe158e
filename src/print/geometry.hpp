/// Positions of dots on a sheet, in mm. All output formats use these functions.
#pragma once

#include "dotpose/files/sheet.hpp"

namespace dotpose::print {

inline constexpr double kInch_mm = 25.4;
inline constexpr double kPixelAt300Dpi_mm = kInch_mm / 300;

/// Returns the x coordinate of the centre of a dot in column `i` of the sheet. `dx` is the sign of
/// the dot's displacement along x (-1, 0 or 1).
inline double dot_x_mm(const Sheet& sheet, int i, int dx) {
    return sheet.origin_x_mm + i * sheet.pattern.spacing_mm + dx * sheet.pattern.displacement_mm;
}

/// Returns the y coordinate of the centre of a dot in row `j` of the sheet. `dy` is the sign of the
/// dot's displacement along y (-1, 0 or 1). y points down.
inline double dot_y_mm(const Sheet& sheet, int j, int dy) {
    return sheet.origin_y_mm + j * sheet.pattern.spacing_mm + dy * sheet.pattern.displacement_mm;
}

}  // namespace dotpose::print
