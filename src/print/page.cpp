#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <fmt/core.h>

#include "dotpose/tools/print.hpp"
#include "geometry.hpp"
#include "raster.hpp"
#include "writers.hpp"

namespace dotpose {
namespace {

constexpr int kGlyphColumns = 5;
constexpr int kGlyphRows = 7;

/// Pixels of a character: rows of 5 pixels, with the leftmost pixel in the highest bit.
struct Glyph {
    char character = ' ';
    std::array<std::uint8_t, kGlyphRows> rows{};
};
constexpr std::array<Glyph, 15> kGlyphs = {{
    {'0', {0b01110, 0b10001, 0b10011, 0b10101, 0b11001, 0b10001, 0b01110}},
    {'1', {0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110}},
    {'2', {0b01110, 0b10001, 0b00001, 0b00010, 0b00100, 0b01000, 0b11111}},
    {'3', {0b11111, 0b00010, 0b00100, 0b00010, 0b00001, 0b10001, 0b01110}},
    {'4', {0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010}},
    {'5', {0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110}},
    {'6', {0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110}},
    {'7', {0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b01000, 0b01000}},
    {'8', {0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110}},
    {'9', {0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100}},
    {'.', {0b00000, 0b00000, 0b00000, 0b00000, 0b00000, 0b01100, 0b01100}},
    {'/', {0b00001, 0b00001, 0b00010, 0b00100, 0b01000, 0b10000, 0b10000}},
    {'-', {0b00000, 0b00000, 0b00000, 0b11111, 0b00000, 0b00000, 0b00000}},
    {'x', {0b00000, 0b00000, 0b10001, 0b01010, 0b00100, 0b01010, 0b10001}},
    {'m', {0b00000, 0b00000, 0b11010, 0b10101, 0b10101, 0b10101, 0b10101}},
}};

/// Image of a whole page with one bit per pixel and 8 pixels per byte. A set bit is ink.
class Bitmap {
  public:
    explicit Bitmap(print::RasterSize size)
        : size_(size),
          stride_bytes_((static_cast<std::size_t>(size.width_px) + 7) / 8),
          bits_(stride_bytes_ * static_cast<std::size_t>(size.height_px)) {}

    void add(const Sheet& sheet, double dpi) {
        auto place = bits_.begin();
        print::rasterize(sheet, dpi, {}, [&](std::span<const std::uint8_t> row) {
            for (const std::uint8_t byte : row) {
                *place = static_cast<std::uint8_t>(*place | byte);
                ++place;
            }
        });
    }

    void add(const InkRectangle& mark, double dpi) {
        const auto px = [dpi](double mm, int side_px) {
            return std::clamp(static_cast<int>(std::lround(mm * dpi / print::kInch_mm)), 0,
                              side_px);
        };
        const int u_end = px(mark.x_mm + mark.width_mm, size_.width_px);
        const int v_end = px(mark.y_mm + mark.height_mm, size_.height_px);
        for (int v = px(mark.y_mm, size_.height_px); v < v_end; ++v) {
            std::uint8_t* row = bits_.data() + static_cast<std::size_t>(v) * stride_bytes_;
            for (int u = px(mark.x_mm, size_.width_px); u < u_end; ++u) {
                row[u / 8] = static_cast<std::uint8_t>(row[u / 8] | (0x80 >> (u % 8)));
            }
        }
    }

    void hand_out(const png::RowSink& sink) const {
        for (auto row = bits_.begin(); row != bits_.end();
             row += static_cast<std::ptrdiff_t>(stride_bytes_)) {
            sink(std::span(row, stride_bytes_));
        }
    }

  private:
    print::RasterSize size_;
    std::size_t stride_bytes_;
    std::vector<std::uint8_t> bits_;
};

void validate(const PrintPage& page) {
    if (page.sheets.empty()) throw BadArgument("the page has no dots");
    for (const Sheet& sheet : page.sheets) {
        dotpose::validate(sheet);
        if (sheet.width_mm == page.width_mm && sheet.height_mm == page.height_mm) continue;
        throw BadArgument(fmt::format("a sheet of {:g} x {:g} mm on a page of {:g} x {:g} mm",
                                      sheet.width_mm, sheet.height_mm, page.width_mm,
                                      page.height_mm));
    }
}

void write_raster(const PrintPage& page, PrintFormat format, const PrintOptions& options,
                  base::OutputFile& file) {
    const print::RasterSize size = print::raster_size(page.sheets.front(), options.dpi);
    Bitmap bitmap(size);
    int sheets_done = 0;
    for (const Sheet& sheet : page.sheets) {
        bitmap.add(sheet, options.dpi);
        print::report(options.progress, ++sheets_done, static_cast<int>(page.sheets.size()));
    }
    for (const InkRectangle& mark : page.marks)
        bitmap.add(mark, options.dpi);
    const auto rows = [&](const png::RowSink& sink) { bitmap.hand_out(sink); };
    const auto write = format == PrintFormat::png ? print::write_png : print::write_tiff;
    write(size, options.dpi, rows, file);
}

}  // namespace

std::vector<InkRectangle> ink_text(std::string_view text, double x_mm, double y_mm,
                                   double height_mm) {
    const double pixel_mm = height_mm / kGlyphRows;
    std::vector<InkRectangle> marks;
    for (const char character : text) {
        const auto glyph = std::ranges::find(kGlyphs, character, &Glyph::character);
        for (int row = 0; glyph != kGlyphs.end() && row < kGlyphRows; ++row) {
            const unsigned bits = glyph->rows[static_cast<std::size_t>(row)];
            for (int column = 0; column < kGlyphColumns; ++column) {
                if ((bits >> (kGlyphColumns - 1 - column) & 1) == 0) continue;
                marks.push_back(
                    {x_mm + column * pixel_mm, y_mm + row * pixel_mm, pixel_mm, pixel_mm});
            }
        }
        x_mm += (kGlyphColumns + 1) * pixel_mm;
    }
    return marks;
}

void write_page(const PrintPage& page, const std::filesystem::path& path,
                const PrintOptions& options) {
    const PrintFormat format = print_format(path);
    validate(page);
    if (format == PrintFormat::text) {
        throw BadArgument(fmt::format("'{}': a page of several regions cannot be written as text",
                                      path.string()));
    }
    if (format != PrintFormat::svg) {
        for (const Sheet& sheet : page.sheets)
            validate_resolution(sheet, options.dpi);
    }
    base::OutputFile file(path);
    if (format == PrintFormat::svg) {
        print::write_svg_page(page, options.progress, file);
    } else if (format == PrintFormat::pdf) {
        print::write_pdf_page(page, options, file);
    } else {
        write_raster(page, format, options, file);
    }
    file.commit();
}

}  // namespace dotpose
