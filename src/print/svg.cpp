#include <cmath>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "geometry.hpp"
#include "symbol_rows.hpp"
#include "writers.hpp"

namespace dotpose::print {
namespace {

// Coordinates are whole numbers of a tenth of a micrometre: short to write, and finer than any
// printer. Each is rounded by itself and only then turned into a step, so nothing adds up.
constexpr double kUnitsPer_mm = 10'000;

std::int64_t to_units(double mm) {
    return std::llround(mm * kUnitsPer_mm);
}

std::string head(const Sheet& sheet) {
    const Pattern& pattern = sheet.pattern;
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}mm\" height=\"{}mm\" "
        "viewBox=\"0 0 {} {}\">\n"
        "<title>Position code: {} x {} cells from ({}, {}), section ({}, {}), "
        "spacing {} mm</title>\n"
        "<g fill=\"none\" stroke=\"#000\" stroke-width=\"{}\" stroke-linecap=\"round\">\n",
        sheet.width_mm, sheet.height_mm, to_units(sheet.width_mm), to_units(sheet.height_mm),
        sheet.columns, sheet.rows, sheet.origin.x, sheet.origin.y, pattern.section.u,
        pattern.section.v, pattern.spacing_mm, pattern.dot_mm * kUnitsPer_mm);
}

}  // namespace

/// A dot is a line of no length with round ends: a full circle in a dozen bytes. One path per row.
void write_svg(const Sheet& sheet, const Progress& progress, OutputFile& file) {
    SymbolRows symbols(sheet);
    file.write(head(sheet));
    std::string line;
    for (int j = 0; j < sheet.rows; ++j) {
        line = "<path d=\"";
        std::int64_t last_x = 0;
        std::int64_t last_y = 0;
        int i = 0;
        for (const Symbol symbol : symbols.row(j)) {
            const std::int64_t x = to_units(dot_x_mm(sheet, i, dx(symbol)));
            const std::int64_t y = to_units(dot_y_mm(sheet, j, dy(symbol)));
            // The first step of a path counts from (0, 0).
            fmt::format_to(std::back_inserter(line), "m{} {}h0", x - last_x, y - last_y);
            last_x = x;
            last_y = y;
            ++i;
        }
        line += "\"/>\n";
        file.write(line);
        file.require_good();
        report(progress, j + 1, sheet.rows);
    }
    file.write("</g>\n</svg>\n");
}

}  // namespace dotpose::print
