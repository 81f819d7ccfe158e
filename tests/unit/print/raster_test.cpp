#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "dotpose/tools/print.hpp"
#include "files.hpp"

namespace dotpose {
namespace {

using print_test::Bitmap;
using print_test::TemporaryDirectory;
using Pixels = std::vector<std::pair<int, int>>;

Bitmap print_and_read(const Sheet& sheet, const char* name, double dpi) {
    const TemporaryDirectory directory;
    PrintOptions options;
    options.dpi = dpi;
    write_sheet(sheet, directory / name, options);
    return print_format(name) == PrintFormat::png ? print_test::read_png(directory / name)
                                                  : print_test::read_tiff(directory / name);
}

Symbol symbol_of(const Sheet& sheet, int i, int j) {
    return symbol_at(sheet.pattern.code,
                     {sheet.origin.x + static_cast<std::uint32_t>(i),
                      sheet.origin.y + static_cast<std::uint32_t>(j)},
                     sheet.pattern.section);
}

Sheet small_sheet() {
    SheetOptions options;
    options.paper = {.width_mm = 25.4, .height_mm = 50.8};
    options.margin_mm = 2;
    options.origin = {.x = 217, .y = 1134};
    return make_sheet(options);
}

// With a spacing of 0.508 mm, the spacing and the displacement are integer multiples of a pixel of
// 1/300 inch. The margin of 2 mm, plus the 0.127 mm by which ink extends beyond an intersection, is
// 25.12 pixels. The first intersection is therefore at the centre of pixel 25. The next
// intersections follow every 6 pixels.
constexpr int kFirst_px = 25;
constexpr int kSpacing_px = 6;

/// Returns the pixels of a dot that is printed at `scale` times 300 dpi. Positions are relative to
/// the top left corner of the pixel that the dot occupies at 300 dpi.
Pixels dot_shape(int scale) {
    if (scale == 1) return {{0, 0}};
    if (scale == 2) return {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    return {{1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}, {3, 1},
            {0, 2}, {1, 2}, {2, 2}, {3, 2}, {1, 3}, {2, 3}};
}

void expect_exact_dots(const Bitmap& page, const Sheet& sheet, int scale) {
    const Pixels shape = dot_shape(scale);
    for (int j = 0; j < sheet.rows; ++j) {
        for (int i = 0; i < sheet.columns; ++i) {
            const Symbol symbol = symbol_of(sheet, i, j);
            const int left = scale * (kFirst_px + kSpacing_px * i + dx(symbol));
            const int top = scale * (kFirst_px + kSpacing_px * j + dy(symbol));
            for (const auto& [u, v] : shape) {
                ASSERT_TRUE(page.at(left + u, top + v)) << i << " " << j << ": " << u << " " << v;
            }
        }
    }
    // The checks above found ink in all expected pixels, which are distinct. If the counts are
    // equal, there is no other ink.
    EXPECT_EQ(page.count_ink(), sheet.columns * sheet.rows * static_cast<int>(shape.size()));
}

TEST(write_raster, fills_whole_printer_pixels_with_the_default_spacing) {
    const Sheet sheet = small_sheet();
    for (const char* name : {"page.png", "page.tif", "page.TIFF"}) {
        for (const int scale : {1, 2, 4}) {
            const Bitmap page = print_and_read(sheet, name, 300 * scale);
            EXPECT_EQ(page.width_px, 300 * scale) << name;
            EXPECT_EQ(page.height_px, 600 * scale) << name;
            EXPECT_EQ(page.bits_per_pixel, 1) << name;
            EXPECT_NEAR(page.x_dpi, 300 * scale, 0.01) << name;
            EXPECT_NEAR(page.y_dpi, 300 * scale, 0.01) << name;
            expect_exact_dots(page, sheet, scale);
        }
    }
}

TEST(write_raster, first_letters_are_those_of_the_code) {
    // At (217, 1134), the pattern has the symbols "dddurddl", according to a test vector that does
    // not depend on `symbol_at`.
    const Bitmap page = print_and_read(small_sheet(), "page.png", 300);
    const Pixels expected = {{0, 1}, {0, 1}, {0, 1}, {0, -1}, {1, 0}, {0, 1}, {0, 1}, {-1, 0}};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const int u = kFirst_px + kSpacing_px * static_cast<int>(i);
        for (const auto& [du, dv] : Pixels{{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
            EXPECT_EQ(page.at(u + du, kFirst_px + dv), std::pair(du, dv) == expected[i])
                << i << ": " << du << " " << dv;
        }
    }
}

/// Distances between the centroids of the printed dots and their expected centres.
struct Errors {
    double largest_px = 0;
    double mean_px = 0;
};

Errors centroid_errors(const Bitmap& page, const Sheet& sheet, double dpi) {
    const double px_per_mm = dpi / 25.4;
    const Pattern& pattern = sheet.pattern;
    const int search_px =
        static_cast<int>(std::ceil((pattern.spacing_mm / 2 - pattern.displacement_mm) * px_per_mm));
    Errors errors;
    for (int j = 0; j < sheet.rows; ++j) {
        for (int i = 0; i < sheet.columns; ++i) {
            const Symbol symbol = symbol_of(sheet, i, j);
            const double x_px = px_per_mm * (sheet.origin_x_mm + i * pattern.spacing_mm +
                                             dx(symbol) * pattern.displacement_mm);
            const double y_px = px_per_mm * (sheet.origin_y_mm + j * pattern.spacing_mm +
                                             dy(symbol) * pattern.displacement_mm);
            double sum_u = 0;
            double sum_v = 0;
            int count = 0;
            for (int v = static_cast<int>(y_px) - search_px; v <= y_px + search_px; ++v) {
                for (int u = static_cast<int>(x_px) - search_px; u <= x_px + search_px; ++u) {
                    if (u < 0 || v < 0 || u >= page.width_px || v >= page.height_px) continue;
                    if (!page.at(u, v)) continue;
                    sum_u += u + 0.5;
                    sum_v += v + 0.5;
                    ++count;
                }
            }
            if (count == 0) {
                ADD_FAILURE() << "no dot at " << i << " " << j;
                return errors;
            }
            const double error_x = sum_u / count - x_px;
            const double error_y = sum_v / count - y_px;
            errors.largest_px = std::max({errors.largest_px, std::abs(error_x), std::abs(error_y)});
            errors.mean_px += (error_x + error_y) / (2.0 * sheet.columns * sheet.rows);
        }
    }
    return errors;
}

TEST(write_raster, rounds_each_dot_by_itself_where_the_spacing_is_no_whole_number) {
    for (const double spacing_mm : {0.5, 0.4713, 0.7}) {
        for (const double dpi : {600.0, 720.0, 1200.0}) {
            SheetOptions options;
            options.paper = {.width_mm = 100, .height_mm = 40};
            options.pattern.spacing_mm = spacing_mm;
            options.pattern.displacement_mm = spacing_mm / 6;
            options.pattern.dot_mm = spacing_mm / 6;
            const Sheet sheet = make_sheet(options);
            const Bitmap page = print_and_read(sheet, "page.png", dpi);
            const Errors errors = centroid_errors(page, sheet, dpi);
            EXPECT_LE(errors.largest_px, 0.5 + 1e-4) << spacing_mm << " mm, " << dpi << " dpi";
            EXPECT_LE(std::abs(errors.mean_px), 0.12) << spacing_mm << " mm, " << dpi << " dpi";
        }
    }
}

TEST(write_raster, has_all_dots_without_a_margin) {
    SheetOptions options;
    options.paper = {.width_mm = 30.013, .height_mm = 20.99};
    options.margin_mm = 0;
    for (const double dpi : {300.0, 431.0, 600.0, 1200.0}) {
        const Sheet sheet = make_sheet(options);
        const Bitmap page = print_and_read(sheet, "page.tif", dpi);
        EXPECT_EQ(page.width_px, std::lround(30.013 * dpi / 25.4));
        EXPECT_EQ(page.height_px, std::lround(20.99 * dpi / 25.4));
        EXPECT_LE(centroid_errors(page, sheet, dpi).largest_px, 1.0) << dpi;
    }
}

TEST(write_raster, keeps_dots_that_rounding_would_push_off_the_page) {
    // The page is 100.4 pixels wide, and the file has 100 pixels. In the last column, the centres
    // of dots that are displaced to the right are at 100.1, so the nearest pixel would be outside
    // the file.
    constexpr double kPixel_mm = 25.4 / 300;
    Sheet sheet;
    sheet.pattern.dot_mm = 0.6 * kPixel_mm;
    sheet.columns = sheet.rows = 16;
    sheet.width_mm = sheet.height_mm = 100.4 * kPixel_mm;
    sheet.origin_x_mm = sheet.origin_y_mm = (99.1 - 15 * kSpacing_px) * kPixel_mm;
    const Bitmap page = print_and_read(sheet, "page.png", 300);
    EXPECT_EQ(page.width_px, 100);
    EXPECT_EQ(page.count_ink(), 16 * 16);
}

TEST(write_raster, refuses_a_resolution_that_cannot_show_the_code) {
    const TemporaryDirectory directory;
    PrintOptions options;
    options.dpi = 200;
    EXPECT_THROW(write_sheet(small_sheet(), directory / "page.png", options), BadArgument);
    EXPECT_THROW(write_sheet(small_sheet(), directory / "page.tif", options), BadArgument);
    EXPECT_TRUE(directory.names().empty());
    EXPECT_NO_THROW(write_sheet(small_sheet(), directory / "page.svg", options));
}

}  // namespace
}  // namespace dotpose
