#include <cmath>
#include <functional>
#include <iterator>
#include <string>

#include <fmt/core.h>

#include "geometry.hpp"
#include "symbol_rows.hpp"
#include "writers.hpp"

namespace dotpose::print {
namespace {

// Drawing units per mm. A unit is 0.1 µm, finer than the resolution of any printer. Integer
// coordinates keep the file short. Positions are rounded before they are subtracted, so rounding
// errors do not accumulate.
constexpr double kUnitsPer_mm = 10'000;

std::int64_t to_units(double mm) {
    return std::llround(mm * kUnitsPer_mm);
}

/// Returns the beginning of a drawing with the size of the page.
std::string head(double width_mm, double height_mm, const std::string& title) {
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}mm\" height=\"{}mm\" "
        "viewBox=\"0 0 {} {}\">\n"
        "<title>{}</title>\n",
        width_mm, height_mm, to_units(width_mm), to_units(height_mm), title);
}

/// Writes one path per row of dots. Each dot is a line of length zero with round ends. It appears
/// as a disc and takes only a dozen bytes.
void write_dots(const Sheet& sheet, const std::function<void(int)>& row_done,
                base::ByteSink& file) {
    SymbolRows symbols(sheet);
    file.write(
        fmt::format("<g fill=\"none\" stroke=\"#000\" stroke-width=\"{}\" "
                    "stroke-linecap=\"round\">\n",
                    sheet.pattern.dot_mm * kUnitsPer_mm));
    std::string line;
    for (int j = 0; j < sheet.rows; ++j) {
        line = "<path d=\"";
        std::int64_t last_x = 0;
        std::int64_t last_y = 0;
        int i = 0;
        for (const Symbol symbol : symbols.row(j)) {
            const std::int64_t x = to_units(dot_x_mm(sheet, i, dx(symbol)));
            const std::int64_t y = to_units(dot_y_mm(sheet, j, dy(symbol)));
            // Each position is relative to the previous one. The first position is relative to (0,
            // 0).
            fmt::format_to(std::back_inserter(line), "m{} {}h0", x - last_x, y - last_y);
            last_x = x;
            last_y = y;
            ++i;
        }
        line += "\"/>\n";
        file.write(line);
        file.require_good();
        row_done(j + 1);
    }
    file.write("</g>\n");
}

}  // namespace

void write_svg(const Sheet& sheet, const Progress& progress, base::ByteSink& file) {
    const Pattern& pattern = sheet.pattern;
    file.write(head(sheet.width_mm, sheet.height_mm,
                    fmt::format("Position code: {} x {} cells from ({}, {}), section ({}, {}), "
                                "spacing {} mm",
                                sheet.columns, sheet.rows, sheet.origin.x, sheet.origin.y,
                                pattern.section.u, pattern.section.v, pattern.spacing_mm)));
    write_dots(
        sheet, [&](int rows_done) { report(progress, rows_done, sheet.rows); }, file);
    file.write("</svg>\n");
}

void write_svg_page(const PrintPage& page, const Progress& progress, base::ByteSink& file) {
    file.write(head(page.width_mm, page.height_mm,
                    fmt::format("Position code: {} regions", page.sheets.size())));
    for (const InkRectangle& mark : page.marks) {
        file.write(fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n",
                               to_units(mark.x_mm), to_units(mark.y_mm), to_units(mark.width_mm),
                               to_units(mark.height_mm)));
    }
    int sheets_done = 0;
    for (const Sheet& sheet : page.sheets) {
        write_dots(
            sheet, [](int) {}, file);
        report(progress, ++sheets_done, static_cast<int>(page.sheets.size()));
    }
    file.write("</svg>\n");
}

}  // namespace dotpose::print
