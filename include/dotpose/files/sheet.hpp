/// Sheet: the dimensions of a printed pattern and of its page. The core does not use this header.
///
/// Coordinate frames (x right, y DOWN):
/// - *pattern*: intersection (i, j) is at (i, j) * spacing_mm.
/// - *sheet*: mm from the top left corner of the page.
#pragma once

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Default grid spacing. With this spacing, dots cover whole printer pixels at 300, 600 and 1200
/// dpi (paper, section III-A.1).
inline constexpr double kDefaultSpacing_mm = 0.508;

/// Maximum width and height of a page, in mm.
inline constexpr double kMaxPage_mm = 100'000;
/// Minimum number of columns and rows of a sheet. Smaller regions cannot be read (paper, section
/// III-A.3).
inline constexpr int kMinSheetCells = 8;

/// A printed pattern: its code variant, its section, and its dimensions in mm.
struct Pattern {
    CodeVariant code = CodeVariant::anoto;
    Section section;
    double spacing_mm = kDefaultSpacing_mm;
    /// Distance from an intersection to the centre of its dot.
    double displacement_mm = kDefaultSpacing_mm / 6;
    double dot_mm = kDefaultSpacing_mm / 6;  ///< diameter of a dot
};

/// Returns the maximum distance in mm, along x or y, from an intersection to the outer edge of its
/// dot.
inline double reach_mm(const Pattern& pattern) {
    return pattern.displacement_mm + pattern.dot_mm / 2;
}

/// Ratio of the printed length to the nominal length, along each axis. It depends on the printer,
/// and is usually different along and across the direction of paper feed.
struct AxisScale {
    double x = 1;
    double y = 1;
};

/// One page: `columns` x `rows` intersections, starting at `origin`.
struct Sheet {
    Pattern pattern;
    Cell origin;
    int columns = 0;
    int rows = 0;
    double width_mm = 0;
    double height_mm = 0;
    double origin_x_mm = 0;  ///< sheet coordinates of the intersection of cell `origin`
    double origin_y_mm = 0;
};

/// Checks all values of a sheet. Throws BadArgument for the first invalid value. A valid sheet
/// meets these conditions:
/// - Lengths are positive and finite, and no side of the page exceeds kMaxPage_mm.
/// - Dots do not touch, and all ink is on the page.
/// - Both components of the section are below kSections.
/// - There are at least kMinSheetCells columns and rows.
/// - The region is inside the code plane.
void validate(const Sheet& sheet);

}  // namespace dotpose

DOTPOSE_END_EXPORT
