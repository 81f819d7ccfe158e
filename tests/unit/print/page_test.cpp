// Tests pages with several regions, and the test page.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/tools/print.hpp"
#include "dotpose/tools/test_page.hpp"
#include "files.hpp"

namespace dotpose {
namespace {

using print_test::Bitmap;
using print_test::TemporaryDirectory;
using testing::HasSubstr;
using testing::IsEmpty;

/// Returns a page of 40 x 20 mm with two regions of 10 x 8 cells and a bar between them.
PrintPage two_regions() {
    PrintPage page;
    page.width_mm = 40;
    page.height_mm = 20;
    for (const double left_mm : {2.54, 25.4}) {
        Sheet sheet;
        sheet.origin = {1000, static_cast<std::uint32_t>(100 * left_mm)};
        sheet.columns = 10;
        sheet.rows = 8;
        sheet.width_mm = page.width_mm;
        sheet.height_mm = page.height_mm;
        sheet.origin_x_mm = left_mm;
        sheet.origin_y_mm = 5.08;
        page.sheets.push_back(sheet);
    }
    page.marks.push_back({.x_mm = 15.24, .y_mm = 2.54, .width_mm = 1.27, .height_mm = 2.54});
    return page;
}

void expect_sum_of_sheets(const Bitmap& together, const Bitmap& first, const Bitmap& second) {
    ASSERT_EQ(together.width_px, first.width_px);
    ASSERT_EQ(together.height_px, first.height_px);
    for (int v = 0; v < together.height_px; ++v) {
        for (int u = 0; u < together.width_px; ++u) {
            // At 600 dpi, 15.24 mm is 360 px, 1.27 mm is 30 px, and 2.54 mm is 60 px.
            const bool in_bar = u >= 360 && u < 390 && v >= 60 && v < 120;
            ASSERT_EQ(together.at(u, v), first.at(u, v) || second.at(u, v) || in_bar)
                << "at " << u << ", " << v;
        }
    }
}

TEST(PrintPage, png_and_tiff_show_all_regions_and_marks) {
    const TemporaryDirectory directory;
    const PrintPage page = two_regions();
    write_sheet(page.sheets[0], directory / "a.png");
    write_sheet(page.sheets[1], directory / "b.png");
    const Bitmap first = print_test::read_png(directory / "a.png");
    const Bitmap second = print_test::read_png(directory / "b.png");
    EXPECT_GT(first.count_ink(), 0);
    write_page(page, directory / "page.png");
    write_page(page, directory / "page.tif");
    expect_sum_of_sheets(print_test::read_png(directory / "page.png"), first, second);
    expect_sum_of_sheets(print_test::read_tiff(directory / "page.tif"), first, second);
}

TEST(PrintPage, svg_has_the_dots_of_each_sheet) {
    const TemporaryDirectory directory;
    const PrintPage page = two_regions();
    write_page(page, directory / "page.svg");
    const std::string svg = print_test::read_file(directory / "page.svg");
    EXPECT_THAT(svg, HasSubstr("width=\"40mm\" height=\"20mm\" viewBox=\"0 0 400000 200000\""));
    EXPECT_THAT(svg,
                HasSubstr("<rect x=\"152400\" y=\"25400\" width=\"12700\" height=\"25400\"/>"));
    for (const Sheet& sheet : page.sheets) {
        write_sheet(sheet, directory / "sheet.svg");
        const std::string alone = print_test::read_file(directory / "sheet.svg");
        const std::size_t begin = alone.find("<g ");
        const std::string dots = alone.substr(begin, alone.find("</g>") - begin);
        EXPECT_GT(dots.size(), 500U);
        EXPECT_THAT(svg, HasSubstr(dots));
    }
}

TEST(PrintPage, what_cannot_be_printed_leaves_no_file) {
    const TemporaryDirectory directory;
    EXPECT_THROW(write_page(two_regions(), directory / "page.txt"), BadArgument);
    EXPECT_THROW(write_page({}, directory / "page.png"), BadArgument);
    PrintPage page = two_regions();
    page.sheets[1].width_mm = 50;
    EXPECT_THROW(write_page(page, directory / "page.png"), BadArgument);
    PrintOptions options;
    options.dpi = 150;
    EXPECT_THROW(write_page(two_regions(), directory / "page.png", options), BadArgument);
    options.dpi = 600;
    options.progress = [](int, int) { return false; };
    EXPECT_THROW(write_page(two_regions(), directory / "page.png", options), Error);
    EXPECT_THROW(write_page(two_regions(), directory / "page.svg", options), Error);
    EXPECT_THAT(directory.names(), IsEmpty());
}

TEST(PrintPage, text_is_drawn_with_rectangles) {
    // A dash consists of five pixels in the fourth of seven rows.
    const auto marks = ink_text(" -", 10, 20, 7);
    ASSERT_EQ(marks.size(), 5U);
    for (std::size_t i = 0; i < marks.size(); ++i) {
        EXPECT_DOUBLE_EQ(marks[i].x_mm, 16 + static_cast<double>(i));
        EXPECT_DOUBLE_EQ(marks[i].y_mm, 23);
        EXPECT_DOUBLE_EQ(marks[i].width_mm, 1);
        EXPECT_DOUBLE_EQ(marks[i].height_mm, 1);
    }
    EXPECT_THAT(ink_text("", 0, 0, 7), IsEmpty());
}

TEST(TestPage, patches_lie_apart_on_the_page_and_name_themselves) {
    const PrintPage page = make_test_page({});
    ASSERT_EQ(page.sheets.size(), 20U);
    for (const Sheet& sheet : page.sheets) {
        validate(sheet);
        const double spacing = sheet.pattern.spacing_mm / kTestUnit_mm;
        const double dot = sheet.pattern.dot_mm / kTestUnit_mm;
        EXPECT_EQ(sheet.origin.x, 410'000'000U + 10'000U * std::lround(spacing));
        EXPECT_EQ(sheet.origin.y, 410'000'000U + 10'000U * std::lround(dot));
        EXPECT_DOUBLE_EQ(sheet.pattern.displacement_mm, sheet.pattern.spacing_mm / 6);
        for (const Sheet& other : page.sheets) {
            if (&other == &sheet) continue;
            const double gap_x_mm = std::abs(other.origin_x_mm - sheet.origin_x_mm) -
                                    std::max(other.columns * other.pattern.spacing_mm,
                                             sheet.columns * sheet.pattern.spacing_mm);
            const double gap_y_mm = std::abs(other.origin_y_mm - sheet.origin_y_mm) -
                                    std::max(other.rows * other.pattern.spacing_mm,
                                             sheet.rows * sheet.pattern.spacing_mm);
            EXPECT_TRUE(gap_x_mm > 1 || gap_y_mm > 1);
        }
        const Cell last{sheet.origin.x + static_cast<std::uint32_t>(sheet.columns - 1),
                        sheet.origin.y + static_cast<std::uint32_t>(sheet.rows - 1)};
        for (const Cell cell : {sheet.origin, last}) {
            const auto patch = test_patch_at(CodeVariant::anoto, cell);
            ASSERT_TRUE(patch);
            EXPECT_DOUBLE_EQ(patch->spacing_mm, sheet.pattern.spacing_mm);
            EXPECT_DOUBLE_EQ(patch->dot_mm, sheet.pattern.dot_mm);
        }
    }
}

TEST(TestPage, other_cells_are_no_patches) {
    for (const Cell cell : {Cell{0, 0}, Cell{410'180'000, 1000}, Cell{1000, 410'040'000},
                            Cell{409'999'000, 410'040'000}, Cell{410'810'000, 410'040'000},
                            Cell{410'180'000, 410'170'000}}) {  // dots would touch
        EXPECT_FALSE(test_patch_at(CodeVariant::anoto, cell)) << cell.x << ", " << cell.y;
    }
}

TEST(TestPage, leaves_out_dots_that_would_touch_and_refuses_nonsense) {
    TestPageOptions options;
    options.spacings = {12, 24};
    options.dots = {4, 8};  // with a spacing of 12 units, dots of 8 units would touch
    EXPECT_EQ(make_test_page(options).sheets.size(), 3U);
    options.dots = {0};
    EXPECT_THROW(make_test_page(options), BadArgument);
    options.dots = {81};
    EXPECT_THROW(make_test_page(options), BadArgument);
    options.dots = {};
    EXPECT_THROW(make_test_page(options), BadArgument);
    options = {};
    options.paper = {30, 30};
    EXPECT_THROW(make_test_page(options), BadArgument);
}

}  // namespace
}  // namespace dotpose
