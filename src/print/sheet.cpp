#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/core.h>

#include "base/sheet_checks.hpp"
#include "dotpose/tools/print.hpp"
#include "geometry.hpp"
#include "regions.hpp"

namespace dotpose {
namespace {

/// Returns the first position at or after `mm` at which a dot covers whole printer pixels at 300
/// dpi.
double snap_up_mm(double mm) {
    return (std::ceil((mm - base::kTolerance_mm) / print::kPixelAt300Dpi_mm - 0.5) + 0.5) *
           print::kPixelAt300Dpi_mm;
}

/// Returns the number of intersections from `first_mm` to `last_mm`, inclusive.
double count_between(double first_mm, double last_mm, double spacing_mm) {
    return std::floor((last_mm - first_mm + base::kTolerance_mm) / spacing_mm) + 1;
}

}  // namespace

Sheet make_sheet(const SheetOptions& options) {
    const auto& [pattern, origin, paper, margin_mm] = options;
    base::validate_paper(paper.width_mm, paper.height_mm);
    base::validate_pattern(pattern);
    if (!(std::isfinite(margin_mm) && margin_mm >= 0)) {
        throw BadArgument(fmt::format("the margin must be 0 mm or more, not {:g}", margin_mm));
    }
    if (2 * margin_mm >= std::min(paper.width_mm, paper.height_mm)) {
        throw BadArgument(
            fmt::format("a margin of {:g} mm leaves nothing of a page of {:g} x {:g} "
                        "mm",
                        margin_mm, paper.width_mm, paper.height_mm));
    }
    const double clear_mm = margin_mm + reach_mm(pattern);
    const double first_mm = snap_up_mm(clear_mm);
    const double columns = count_between(first_mm, paper.width_mm - clear_mm, pattern.spacing_mm);
    const double rows = count_between(first_mm, paper.height_mm - clear_mm, pattern.spacing_mm);
    base::validate_region("columns", 'x', origin.x, columns);
    base::validate_region("rows", 'y', origin.y, rows);

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
        base::validate_region("columns", 'x', sheet.origin.x, sheet.columns);
        base::validate_region("rows", 'y', sheet.origin.y, sheet.rows);
    }
    return sheets;
}

}  // namespace dotpose
