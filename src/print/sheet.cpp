#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/core.h>

#include "dotpose/tools/print.hpp"
#include "geometry.hpp"
#include "regions.hpp"

namespace dotpose {
namespace {

// Decimal lengths are not exact in binary, so comparisons allow a tenth of a nanometre, which is
// far below the accuracy of any printer.
constexpr double kTolerance_mm = 1e-7;
constexpr double kPixelAt300Dpi_mm = print::kInch_mm / 300;

void require_length(const char* what, double mm, double smallest_mm = 0) {
    if (std::isfinite(mm) && mm > smallest_mm) return;
    throw BadArgument(
        fmt::format("the {} must be more than {:g} mm, not {:g}", what, smallest_mm, mm));
}

void validate_paper(double width_mm, double height_mm) {
    for (const double mm : {width_mm, height_mm}) {
        if (mm > 0 && mm <= kMaxPage_mm) continue;
        throw BadArgument(
            fmt::format("a page of {:g} x {:g} mm: each side must be over 0 and at most "
                        "{:.0f} mm",
                        width_mm, height_mm, kMaxPage_mm));
    }
}

void validate_pattern(const Pattern& pattern) {
    require_length("spacing", pattern.spacing_mm);
    require_length("displacement", pattern.displacement_mm);
    require_length("dot diameter", pattern.dot_mm);
    // Two neighbours displaced towards each other are the closest pair of dots.
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

/// Throws BadArgument unless `count` cells from `first` fit into the plane. `count` is a double
/// because values that no int can hold are checked too.
void validate_region(const char* what, char axis, std::uint32_t first, double count) {
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

/// Returns the first position at or after `mm` at which a dot fills whole printer pixels at 300
/// dpi.
double snap_up_mm(double mm) {
    return (std::ceil((mm - kTolerance_mm) / kPixelAt300Dpi_mm - 0.5) + 0.5) * kPixelAt300Dpi_mm;
}

/// Number of intersections from `first_mm` to `last_mm`, both included.
double count_between(double first_mm, double last_mm, double spacing_mm) {
    return std::floor((last_mm - first_mm + kTolerance_mm) / spacing_mm) + 1;
}

}  // namespace

Sheet make_sheet(const SheetOptions& options) {
    const auto& [pattern, origin, paper, margin_mm] = options;
    validate_paper(paper.width_mm, paper.height_mm);
    validate_pattern(pattern);
    if (!(std::isfinite(margin_mm) && margin_mm >= 0)) {
        throw BadArgument(fmt::format("the margin must be 0 mm or more, not {:g}", margin_mm));
    }
    if (2 * margin_mm >= std::min(paper.width_mm, paper.height_mm)) {
        throw BadArgument(
            fmt::format("a margin of {:g} mm leaves nothing of a page of {:g} x {:g} "
                        "mm",
                        margin_mm, paper.width_mm, paper.height_mm));
    }
    const double clear_mm = margin_mm + print::reach_mm(pattern);
    const double first_mm = snap_up_mm(clear_mm);
    const double columns = count_between(first_mm, paper.width_mm - clear_mm, pattern.spacing_mm);
    const double rows = count_between(first_mm, paper.height_mm - clear_mm, pattern.spacing_mm);
    validate_region("columns", 'x', origin.x, columns);
    validate_region("rows", 'y', origin.y, rows);

    Sheet sheet;
    sheet.pattern = pattern;
    sheet.origin = origin;
    sheet.columns = static_cast<int>(columns);
    sheet.rows = static_cast<int>(rows);
    sheet.width_mm = paper.width_mm;
    sheet.height_mm = paper.height_mm;
    sheet.origin_x_mm = first_mm;
    sheet.origin_y_mm = first_mm;
    return sheet;
}

std::vector<Sheet> make_sheets(const SheetOptions& options, int pages) {
    if (pages < 1 || pages > kMaxPages) {
        throw BadArgument(
            fmt::format("{} pages: a document has 1 to {} of them", pages, kMaxPages));
    }
    std::vector<Sheet> sheets(static_cast<std::size_t>(pages), make_sheet(options));
    print::Regions regions(options.origin);
    for (Sheet& sheet : sheets) {
        sheet.origin = regions.take(sheet.columns, sheet.rows);
        validate_region("columns", 'x', sheet.origin.x, sheet.columns);
        validate_region("rows", 'y', sheet.origin.y, sheet.rows);
    }
    return sheets;
}

void validate(const Sheet& sheet) {
    validate_paper(sheet.width_mm, sheet.height_mm);
    validate_pattern(sheet.pattern);
    validate_region("columns", 'x', sheet.origin.x, sheet.columns);
    validate_region("rows", 'y', sheet.origin.y, sheet.rows);
    const double reach_mm = print::reach_mm(sheet.pattern);
    const auto inside = [&](double first_mm, int count, double size_mm) {
        const double last_mm = first_mm + (count - 1) * sheet.pattern.spacing_mm;
        return first_mm >= reach_mm - kTolerance_mm &&
               last_mm <= size_mm - reach_mm + kTolerance_mm;
    };
    if (inside(sheet.origin_x_mm, sheet.columns, sheet.width_mm) &&
        inside(sheet.origin_y_mm, sheet.rows, sheet.height_mm)) {
        return;
    }
    throw BadArgument(
        fmt::format("{} x {} dots, {:g} mm apart and starting at ({:g}, {:g}) mm, do "
                    "not lie on a page of {:g} x {:g} mm",
                    sheet.columns, sheet.rows, sheet.pattern.spacing_mm, sheet.origin_x_mm,
                    sheet.origin_y_mm, sheet.width_mm, sheet.height_mm));
}

}  // namespace dotpose
