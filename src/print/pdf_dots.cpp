#include "pdf_dots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include <fmt/core.h>
#include <qpdf/Pipeline.hh>

#include "geometry.hpp"
#include "symbol_rows.hpp"
#include "writers.hpp"

namespace dotpose::print {
namespace {

constexpr int kDotsPerStream = 250'000;

// --- glyphs -------------------------------------------------------------------------------------

/// Number of font units per em. An em is one spacing of the grid, so the width of every glyph is a
/// whole number and the text advances without rounding errors.
constexpr double kUnitsPerEm = 1000;

/// Returns a circle as four Bezier curves. With the factor 0.5523, the error of the radius is at
/// most 0.03 %.
std::string circle(double x, double y, double r) {
    const double k = 0.5522847498 * r;
    return fmt::format(
        "{:.3f} {:.3f} m {:.3f} {:.3f} {:.3f} {:.3f} {:.3f} {:.3f} c "
        "{:.3f} {:.3f} {:.3f} {:.3f} {:.3f} {:.3f} c {:.3f} {:.3f} {:.3f} {:.3f} {:.3f} {:.3f} c "
        "{:.3f} {:.3f} {:.3f} {:.3f} {:.3f} {:.3f} c f\n",
        x + r, y, x + r, y + k, x + k, y + r, x, y + r, x - k, y + r, x - r, y + k, x - r, y, x - r,
        y - k, x - k, y - r, x, y - r, x + k, y - r, x + r, y - k, x + r, y);
}

/// Returns the glyph that draws the dot of one symbol. The origin of the glyph is the lower left
/// corner of the square around an undisplaced dot, so the dot fills whole pixels if the origin is
/// at the corner of a pixel.
std::string glyph(const Pattern& pattern, Symbol symbol) {
    const double per_mm = kUnitsPerEm / pattern.spacing_mm;
    const double r = pattern.dot_mm / 2 * per_mm;
    const double x = r + dx(symbol) * pattern.displacement_mm * per_mm;
    const double y = r - dy(symbol) * pattern.displacement_mm * per_mm;
    return fmt::format("{} 0 {:.3f} {:.3f} {:.3f} {:.3f} d1\n", kUnitsPerEm, x - r, y - r, x + r,
                       y + r) +
           circle(x, y, r);
}

/// Returns the smallest shift in px, to the right or down, after which all renderers round the
/// origin of a glyph to the same pixel. Tries shifts of up to 0.3 px. If none of them is
/// sufficient, returns the shift that is farthest from all rounding thresholds.
///
/// Renderers count pixels from the top left or from the bottom left corner of the page, and either
/// truncate or round to the nearest pixel. `near_px` and `far_px` are the distances of the origin
/// from the two sides of the page at the chosen resolution. The shift also works at half and at
/// twice this resolution.
double clear_shift_px(double near_px, double far_px) {
    constexpr double kClear_px = 0.05;
    const auto clearance_px = [&](double shift_px) {
        double min_px = 1;
        for (const double place_px : {near_px + shift_px, far_px - shift_px}) {
            for (const double scale : {0.5, 1.0, 2.0}) {
                const double halves = 2 * scale * place_px;
                min_px = std::min(min_px, std::abs(halves - std::round(halves)) / 2);
            }
        }
        return min_px;
    };
    double best_px = 0;
    for (int step = 0; step <= 30; ++step) {
        const double shift_px = 0.01 * step;
        if (clearance_px(shift_px) >= kClear_px) return shift_px;
        if (clearance_px(shift_px) > clearance_px(best_px)) best_px = shift_px;
    }
    return best_px;
}

void write_glyph_rows(const Sheet& sheet, double dpi, int first_row, int end_row, RowCount& rows,
                      Pipeline& out) {
    const double px_per_mm = dpi / kInch_mm;
    const double half_mm = sheet.pattern.dot_mm / 2;
    const double left_mm = sheet.origin_x_mm - half_mm;
    const double top_mm = sheet.origin_y_mm + half_mm;  // y coordinate of the first baseline
    const auto shift_mm = [&](double from_mm, double size_mm) {
        return clear_shift_px(from_mm * px_per_mm, (size_mm - from_mm) * px_per_mm) / px_per_mm;
    };
    const double x_pt = (left_mm + shift_mm(left_mm, sheet.width_mm)) * kPointsPerMm;
    const double first_mm = top_mm + shift_mm(top_mm, sheet.height_mm);

    SymbolRows symbols(sheet);
    // An empty ActualText prevents viewers from finding or copying the glyphs as letters.
    std::string line = fmt::format("/Span <</ActualText ()>> BDC BT 0 0 0 1 k /Dots {:.9f} Tf\n",
                                   sheet.pattern.spacing_mm * kPointsPerMm);
    for (int j = first_row; j < end_row; ++j) {
        const double y_mm = sheet.height_mm - first_mm - j * sheet.pattern.spacing_mm;
        fmt::format_to(std::back_inserter(line), "1 0 0 1 {:.4f} {:.4f} Tm(", x_pt,
                       y_mm * kPointsPerMm);
        for (const Symbol symbol : symbols.row(j))
            line += letter(symbol);
        line += ")Tj\n";
        out.writeString(line);
        line.clear();
        ++rows.done;
    }
    out.writeCStr("ET EMC\n");
}

// --- strokes ------------------------------------------------------------------------------------

/// Unit of length that makes spacing and displacement integers. Integers are short, and renderers
/// do not round them.
struct WholeUnits {
    int spacing = 0;
    int displacement = 0;
    double unit_mm = 0;
};

WholeUnits whole_units(const Pattern& pattern) {
    constexpr double kTolerance_mm = 5e-5;
    constexpr int kMaxUnitsPerSpacing = 10'000;
    WholeUnits units;
    for (int spacing = 1; spacing <= kMaxUnitsPerSpacing; ++spacing) {
        units.spacing = spacing;
        units.unit_mm = pattern.spacing_mm / spacing;
        units.displacement = static_cast<int>(std::lround(pattern.displacement_mm / units.unit_mm));
        const double error_mm = pattern.displacement_mm - units.displacement * units.unit_mm;
        if (std::abs(error_mm) < kTolerance_mm) break;
    }
    return units;
}

// Number of columns per tile. A tile is a segment of a row of dots. Tiles with equal symbols have
// equal text, so deflate encodes most tiles as references to earlier rows.
constexpr int kTileColumns = 8;
// Number of columns after which the absolute position is written again. Otherwise, the rounding
// errors of a renderer would accumulate from tile to tile.
constexpr int kRunColumns = 16 * kTileColumns;

/// Operators that draw each of the four symbols in each column of a tile.
using TileDots = std::array<std::array<std::string, 4>, kTileColumns>;

TileDots tile_dots(const WholeUnits& units) {
    TileDots dots;
    for (int column = 0; column < kTileColumns; ++column) {
        for (const Symbol symbol : {Symbol::up, Symbol::left, Symbol::right, Symbol::down}) {
            const int x = column * units.spacing + dx(symbol) * units.displacement;
            const int y = dy(symbol) * units.displacement;
            dots[static_cast<std::size_t>(column)][static_cast<std::size_t>(symbol)] =
                fmt::format("{0} {1} m {0} {1} l\n", x, y);
        }
    }
    return dots;
}

void write_stroke_rows(const Sheet& sheet, int first_row, int end_row, RowCount& rows,
                       Pipeline& out) {
    const WholeUnits units = whole_units(sheet.pattern);
    const TileDots dots = tile_dots(units);
    const double unit_pt = units.unit_mm * kPointsPerMm;
    SymbolRows symbols(sheet);
    std::string line = fmt::format(
        "q 0 0 0 1 K 1 J {:.6f} w {:.12f} 0 0 {:.12f} {:.6f} {:.6f} cm\n",
        sheet.pattern.dot_mm / units.unit_mm, unit_pt, -unit_pt, sheet.origin_x_mm * kPointsPerMm,
        (sheet.height_mm - dot_y_mm(sheet, first_row, 0)) * kPointsPerMm);
    const auto put = std::back_inserter(line);
    for (int j = first_row; j < end_row; ++j) {
        const std::vector<Symbol>& row = symbols.row(j);
        for (int i = 0; i < sheet.columns; ++i) {
            const int in_tile = i % kTileColumns;
            if (i % kRunColumns == 0) {
                fmt::format_to(put, "{}q 1 0 0 1 {} {} cm\n", i == 0 ? "" : "S Q ",
                               std::int64_t{i} * units.spacing,
                               std::int64_t{j - first_row} * units.spacing);
            } else if (in_tile == 0) {
                fmt::format_to(put, "S 1 0 0 1 {} 0 cm\n", kTileColumns * units.spacing);
            }
            const auto symbol = static_cast<std::size_t>(row[static_cast<std::size_t>(i)]);
            line += dots[static_cast<std::size_t>(in_tile)][symbol];
        }
        line += "S Q\n";
        out.writeString(line);
        line.clear();
        ++rows.done;
    }
    out.writeCStr("Q\n");
}

// ------------------------------------------------------------------------------------------------

/// Computes the data of a content stream when qpdf requests them.
class DotRows : public QPDFObjectHandle::StreamDataProvider {
  public:
    DotRows(const Sheet& sheet, DotDrawing drawing, double dpi, int first_row, int end_row,
            std::shared_ptr<RowCount> rows)
        : sheet_(sheet),
          drawing_(drawing),
          dpi_(dpi),
          first_row_(first_row),
          end_row_(end_row),
          rows_(std::move(rows)) {}

    void provideStreamData(const QPDFObjGen& /*id*/, Pipeline* out) override {
        // After an error, qpdf may request the data again.
        if (rows_->stopped) std::rethrow_exception(rows_->stopped);
        if (drawing_ == DotDrawing::glyphs) {
            write_glyph_rows(sheet_, dpi_, first_row_, end_row_, *rows_, *out);
        } else {
            write_stroke_rows(sheet_, first_row_, end_row_, *rows_, *out);
        }
        out->finish();
        const auto as_int = [](std::int64_t count) {
            return static_cast<int>(std::min<std::int64_t>(count, std::numeric_limits<int>::max()));
        };
        try {
            report(rows_->progress, as_int(rows_->done), as_int(rows_->total));
        } catch (...) {
            rows_->stopped = std::current_exception();
            throw;
        }
    }

  private:
    Sheet sheet_;
    DotDrawing drawing_;
    double dpi_;
    int first_row_;
    int end_row_;
    std::shared_ptr<RowCount> rows_;
};

bool same_dots(const Pattern& a, const Pattern& b) {
    return a.spacing_mm == b.spacing_mm && a.displacement_mm == b.displacement_mm &&
           a.dot_mm == b.dot_mm;
}

}  // namespace

bool is_whole_pixels(const Pattern& pattern, double dpi) {
    const auto is_whole = [dpi](double mm, double tolerance_px) {
        const double px = mm * dpi / kInch_mm;
        return std::round(px) >= 1 && std::abs(px - std::round(px)) < tolerance_px;
    };
    // Spacing errors accumulate over the page, so the spacing has a smaller tolerance than the
    // other lengths.
    return is_whole(pattern.spacing_mm, 1e-6) && is_whole(pattern.displacement_mm, 0.01) &&
           is_whole(pattern.dot_mm, 0.01);
}

DotDrawing resolve_drawing(DotDrawing asked, const Pattern& pattern, double dpi) {
    const bool exact = is_whole_pixels(pattern, dpi);
    if (asked == DotDrawing::automatic) return exact ? DotDrawing::glyphs : DotDrawing::strokes;
    if (asked == DotDrawing::glyphs && !exact) {
        const double px_per_mm = dpi / kInch_mm;
        throw BadArgument(fmt::format(
            "dots drawn as glyphs need whole pixels: at {:g} dpi the spacing is {:.4g}, the "
            "displacement {:.4g} and the dot {:.4g} pixels",
            dpi, pattern.spacing_mm * px_per_mm, pattern.displacement_mm * px_per_mm,
            pattern.dot_mm * px_per_mm));
    }
    return asked;
}

DotContent::DotContent(QPDF& pdf, double dpi, DotDrawing asked, std::shared_ptr<RowCount> rows)
    : pdf_(pdf), dpi_(dpi), asked_(asked), rows_(std::move(rows)) {}

std::vector<QPDFObjectHandle> DotContent::streams(const Sheet& sheet) {
    const DotDrawing drawing = resolve_drawing(asked_, sheet.pattern, dpi_);
    const int rows_per_stream = std::max(1, kDotsPerStream / sheet.columns);
    rows_->total += sheet.rows;
    std::vector<QPDFObjectHandle> streams;
    for (int row = 0; row < sheet.rows; row += rows_per_stream) {
        const int end_row = std::min(sheet.rows, row + rows_per_stream);
        QPDFObjectHandle stream = QPDFObjectHandle::newStream(&pdf_);
        stream.replaceStreamData(
            std::make_shared<DotRows>(sheet, drawing, dpi_, row, end_row, rows_),
            QPDFObjectHandle::newNull(), QPDFObjectHandle::newNull());
        streams.push_back(stream);
    }
    return streams;
}

QPDFObjectHandle DotContent::resources(const Sheet& sheet) {
    QPDFObjectHandle resources = QPDFObjectHandle::newDictionary();
    if (resolve_drawing(asked_, sheet.pattern, dpi_) == DotDrawing::glyphs) {
        QPDFObjectHandle fonts = QPDFObjectHandle::newDictionary();
        fonts.replaceKey("/Dots", font(sheet.pattern));
        resources.replaceKey("/Font", fonts);
    }
    return resources;
}

std::vector<QPDFObjectHandle> DotContent::forms(const Sheet& sheet) {
    std::vector<QPDFObjectHandle> forms = streams(sheet);
    for (QPDFObjectHandle& form : forms) {
        QPDFObjectHandle dict = form.getDict();
        dict.replaceKey("/Type", QPDFObjectHandle::newName("/XObject"));
        dict.replaceKey("/Subtype", QPDFObjectHandle::newName("/Form"));
        dict.replaceKey("/BBox", QPDFObjectHandle::parse(fmt::format(
                                     "[0 0 {:.4f} {:.4f}]", sheet.width_mm * kPointsPerMm,
                                     sheet.height_mm * kPointsPerMm)));
        dict.replaceKey("/Resources", resources(sheet));
    }
    return forms;
}

QPDFObjectHandle DotContent::font(const Pattern& pattern) {
    if (font_.isInitialized() && same_dots(pattern, font_pattern_)) return font_;
    QPDFObjectHandle glyphs = QPDFObjectHandle::newDictionary();
    for (const Symbol symbol : {Symbol::up, Symbol::left, Symbol::right, Symbol::down}) {
        glyphs.replaceKey(std::string("/") + letter(symbol),
                          QPDFObjectHandle::newStream(&pdf_, glyph(pattern, symbol)));
    }
    // The bounding box of a font must contain all glyphs, but it may be larger.
    const auto reach =
        static_cast<int>(std::ceil(kUnitsPerEm * (reach_mm(pattern) * 2) / pattern.spacing_mm));
    std::string widths;
    for (char code = 'd'; code <= 'u'; ++code)
        widths += fmt::format("{} ", kUnitsPerEm);
    font_ = pdf_.makeIndirectObject(QPDFObjectHandle::parse(
        fmt::format("<< /Type /Font /Subtype /Type3 /FontBBox [{0} {0} {1} {1}] "
                    "/FontMatrix [0.001 0 0 0.001 0 0] /FirstChar {2} /LastChar {3} /Widths [{4}] "
                    "/Encoding << /Type /Encoding /Differences [100 /d 108 /l 114 /r 117 /u] >> "
                    "/Resources << >> >>",
                    -reach, reach, int{'d'}, int{'u'}, widths)));
    font_.replaceKey("/CharProcs", glyphs);
    font_pattern_ = pattern;
    return font_;
}

}  // namespace dotpose::print
