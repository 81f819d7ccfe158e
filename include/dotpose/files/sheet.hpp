/// Sheet: the measures of a printed pattern and of the page it stands on. The core does not need
/// it.
///
/// Frames (both x right, y DOWN): *pattern*, where intersection (i, j) lies at (i, j) * spacing_mm;
/// *sheet*, in mm from the top left corner of the page.
#pragma once

#include "dotpose/code.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Grid spacing at which dots fall on printer pixels at 300, 600 and 1200 dpi (paper III-A.1).
inline constexpr double kDefaultSpacing_mm = 0.508;

/// Largest width and height of a page, in mm.
inline constexpr double kMaxPage_mm = 100'000;
/// Fewest columns and rows of a sheet: smaller regions cannot be read (paper section III-A.3).
inline constexpr int kMinSheetCells = 8;

/// Measures of a printed pattern, in mm.
struct Pattern {
    Profile profile = Profile::anoto;
    Section section;
    double spacing_mm = kDefaultSpacing_mm;
    double displacement_mm = kDefaultSpacing_mm / 6;  ///< from the intersection to the dot's centre
    double dot_mm = kDefaultSpacing_mm / 6;           ///< diameter of a dot
};

/// Returns the greatest distance of ink from its intersection along x or y, in mm.
inline double reach_mm(const Pattern& pattern) {
    return pattern.displacement_mm + pattern.dot_mm / 2;
}

/// Printed length of a unit length, per axis: printers differ, and they scale the direction of
/// paper feed and that of the scan differently.
struct AxisScale {
    double x = 1;
    double y = 1;
};

/// One page: `columns` x `rows` intersections, the first of which is `origin`.
struct Sheet {
    Pattern pattern;
    Cell origin;
    int columns = 0;
    int rows = 0;
    double width_mm = 0;
    double height_mm = 0;
    double origin_x_mm = 0;  ///< sheet coordinates of the intersection `origin`
    double origin_y_mm = 0;
};

/// Checks a sheet from any source: lengths positive and finite, dots apart from each other, section
/// below kSections, at least kMinSheetCells columns and rows, region inside the code plane, all ink
/// on the page. Throws BadArgument naming the first value that is wrong.
void validate(const Sheet& sheet);

}  // namespace dotpose

#pragma GCC visibility pop
