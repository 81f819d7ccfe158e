#include "dotpose/files/sheet.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "base/sheet_checks.hpp"
#include "dotpose/files/error.hpp"

namespace dotpose {
namespace {

void require_length(const char* what, double mm, double smallest_mm = 0) {
    if (std::isfinite(mm) && mm > smallest_mm) return;
    throw BadArgument(
        fmt::format("the {} must be more than {:g} mm, not {:g}", what, smallest_mm, mm));
}

}  // namespace

void base::validate_paper(double width_mm, double height_mm) {
    for (const double mm : {width_mm, height_mm}) {
        if (mm > 0 && mm <= kMaxPage_mm) continue;
        throw BadArgument(
            fmt::format("a page of {:g} x {:g} mm: each side must be over 0 and at most "
                        "{:.0f} mm",
                        width_mm, height_mm, kMaxPage_mm));
    }
}

void base::validate_pattern(const Pattern& pattern) {
    require_length("spacing", pattern.spacing_mm);
    require_length("displacement", pattern.displacement_mm);
    require_length("dot diameter", pattern.dot_mm);
    // Two neighbouring dots are closest when they are displaced towards each other.
    const double closest_mm = pattern.spacing_mm - 2 * pattern.displacement_mm;
    if (closest_mm <= 0) {
        throw BadArgument(
            fmt::format("a spacing of {:g} mm is too small for a displacement of {:g} mm: "
                        "it must be more than {:g} mm",
                        pattern.spacing_mm, pattern.displacement_mm, 2 * pattern.displacement_mm));
    }
    if (pattern.dot_mm >= closest_mm) {
        throw BadArgument(
            fmt::format("dots of {:g} mm would touch their neighbours: with a spacing of "
                        "{:g} mm and a displacement of {:g} mm they must be under {:g} mm",
                        pattern.dot_mm, pattern.spacing_mm, pattern.displacement_mm, closest_mm));
    }
    if (pattern.section.u >= kSections || pattern.section.v >= kSections) {
        throw BadArgument(fmt::format("section {},{}: both numbers must be 0 to {}",
                                      pattern.section.u, pattern.section.v, kSections - 1));
    }
}

void base::validate_region(const char* what, char axis, std::uint32_t first, double count) {
    if (count < kMinSheetCells) {
        throw BadArgument(
            fmt::format("only {:.0f} {} of dots fit on the page inside its margins; "
                        "at least {} are needed",
                        std::max(count, 0.0), what, kMinSheetCells));
    }
    if (first >= kPositionsPerAxis || count > kPositionsPerAxis - first) {
        throw BadArgument(
            fmt::format("{:.0f} {} from {} = {} run past the end of the code plane, "
                        "whose last position is {}",
                        count, what, axis, first, kPositionsPerAxis - 1));
    }
}

void validate(const Sheet& sheet) {
    base::validate_paper(sheet.width_mm, sheet.height_mm);
    base::validate_pattern(sheet.pattern);
    base::validate_region("columns", 'x', sheet.origin.x, sheet.columns);
    base::validate_region("rows", 'y', sheet.origin.y, sheet.rows);
    const double reach = reach_mm(sheet.pattern);
    const auto inside = [&](double first_mm, int count, double size_mm) {
        const double last_mm = first_mm + (count - 1) * sheet.pattern.spacing_mm;
        return first_mm >= reach - base::kTolerance_mm &&
               last_mm <= size_mm - reach + base::kTolerance_mm;
    };
    if (inside(sheet.origin_x_mm, sheet.columns, sheet.width_mm) &&
        inside(sheet.origin_y_mm, sheet.rows, sheet.height_mm)) {
        return;
    }
    throw BadArgument(
        fmt::format("{} x {} dots, {:g} mm apart and starting at ({:g}, {:g}) mm, do not fit on a "
                    "page of {:g} x {:g} mm",
                    sheet.columns, sheet.rows, sheet.pattern.spacing_mm, sheet.origin_x_mm,
                    sheet.origin_y_mm, sheet.width_mm, sheet.height_mm));
}

}  // namespace dotpose
