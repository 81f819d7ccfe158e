/// Positions of dots on a sheet, in mm, as the writers of all file formats compute them.
#pragma once

#include "dotpose/files/sheet.hpp"

namespace dotpose::print {

inline constexpr double kInch_mm = 25.4;
inline constexpr double kPixelAt300Dpi_mm = kInch_mm / 300;

/// x of the centre of a dot in column `i` of the sheet, displaced by `dx` (-1, 0 or 1).
inline double dot_x_mm(const Sheet& sheet, int i, int dx) {
    return sheet.origin_x_mm + i * sheet.pattern.spacing_mm + dx * sheet.pattern.displacement_mm;
}

/// y of the centre of a dot in row `j` of the sheet, displaced by `dy` (-1, 0 or 1); y is down.
inline double dot_y_mm(const Sheet& sheet, int j, int dy) {
    return sheet.origin_y_mm + j * sheet.pattern.spacing_mm + dy * sheet.pattern.displacement_mm;
}

}  // namespace dotpose::print
