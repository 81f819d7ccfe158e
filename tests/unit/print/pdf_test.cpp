#include <array>
#include <cstdio>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/tools/print.hpp"
#include "files.hpp"
#include "print/pdf_labels.hpp"
#include "print/pdf_script_text.hpp"

namespace dotpose {
namespace {

using print_test::read_file;
using print_test::TemporaryDirectory;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

SheetOptions small_page(double margin_mm) {
    SheetOptions options;
    options.paper = {100, 60};
    options.margin_mm = margin_mm;
    return options;
}

PrintOptions named() {
    PrintOptions options;
    options.name = "door (left)";
    options.command = "dotpose print -o door.pdf";
    return options;
}

std::string content_of_labels(const Sheet& sheet, print::PageNumber page,
                              const PrintOptions& options) {
    QPDF pdf;
    pdf.emptyPDF();
    print::ScriptText script(pdf);
    return print::label_content(sheet, page, options, script);
}

TEST(labels, say_what_is_on_the_page) {
    SheetOptions options = small_page(10);
    options.origin = {300, 500};
    options.pattern.section = {4, 62};
    const Sheet sheet = make_sheet(options);
    const std::string content = content_of_labels(sheet, {2, 3}, named());
    EXPECT_THAT(content, HasSubstr("door"));
    EXPECT_THAT(content, HasSubstr("page 2 of 3"));
    EXPECT_THAT(content, HasSubstr("cells 300,500 to"));
    EXPECT_THAT(content, HasSubstr("section 4,62"));
    EXPECT_THAT(content, HasSubstr("dotpose print -o door.pdf"));
    EXPECT_THAT(content, HasSubstr("0 0 0 1 k 0 0 0 1 K"));
    EXPECT_THAT(content, HasSubstr("(0 mm) Tj"));
    // The numbers on the ruler are distances from the edge of the page. The dots begin at 10.2 mm
    // and are 79.8 mm wide, so they end at 90.0 mm. The ruler ends before that, and its last number
    // is 80.
    EXPECT_THAT(content, HasSubstr("(80) Tj"));
    EXPECT_THAT(content, Not(HasSubstr("(90) Tj")));
}

/// The positions of all ticks and numbers on a ruler, in mm from the corner of the page.
struct Marks {
    std::vector<double> ticks_x_mm;  ///< ticks of the ruler above the dots
    std::vector<double> ticks_y_mm;  ///< ticks of the ruler beside the dots
    std::map<std::string, std::array<double, 2>> texts_mm;
};

Marks marks_of(const std::string& content, double height_mm) {
    const double mm_per_pt = 25.4 / 72;
    Marks marks;
    std::istringstream lines(content);
    for (std::string line; std::getline(lines, line);) {
        double x = 0;
        double y = 0;
        double x2 = 0;
        double y2 = 0;
        char text[100] = {};
        char end = 0;
        if (std::sscanf(line.c_str(), "%lf %lf m %lf %lf %c", &x, &y, &x2, &y2, &end) == 5 &&
            end == 'l' && line.ends_with(" l")) {
            if (x == x2) marks.ticks_x_mm.push_back(x * mm_per_pt);
            if (y == y2) marks.ticks_y_mm.push_back(height_mm - y * mm_per_pt);
        } else if (std::sscanf(line.c_str(), "%*d %*d %*d %*d %lf %lf Tm (%99[^)]) Tj", &x, &y,
                               text) == 3) {
            marks.texts_mm[text] = {x * mm_per_pt, height_mm - y * mm_per_pt};
        }
    }
    return marks;
}

TEST(labels, rulers_count_from_the_corner_of_the_page) {
    const Sheet sheet = make_sheet(small_page(10));
    const Marks marks = marks_of(content_of_labels(sheet, {1, 1}, named()), sheet.height_mm);
    // On each ruler, the last tick is at the last whole millimetre before the end of the dots. It
    // is at 89 mm on the ruler above the dots, and at 49 mm on the ruler beside them. There are no
    // ticks from 5 to 9 mm, where the arrows are.
    std::vector<double> expected_x = {1, 2, 3, 4};
    std::vector<double> expected_y = expected_x;
    for (int mm = 10; mm <= 89; ++mm) {
        expected_x.push_back(mm);
        if (mm <= 49) expected_y.push_back(mm);
    }
    const auto near = [](double distance_mm) { return testing::DoubleNear(distance_mm, 0.001); };
    EXPECT_THAT(marks.ticks_x_mm, testing::Pointwise(testing::DoubleNear(0.001), expected_x));
    EXPECT_THAT(marks.ticks_y_mm, testing::Pointwise(testing::DoubleNear(0.001), expected_y));
    // Each number is centred on its tick. Two digits are 2 * 0.556 * 4.5 points = 1.765 mm wide.
    ASSERT_TRUE(marks.texts_mm.contains("80"));
    EXPECT_THAT(marks.texts_mm.at("80")[0] + 1.765 / 2, near(80));
}

TEST(labels, show_the_origin_and_its_pattern_coordinates) {
    SheetOptions options;
    options.paper = {148, 210};
    options.margin_mm = 10;
    options.origin = {1000, 3};
    const Sheet sheet = make_sheet(options);
    const std::string content = content_of_labels(sheet, {1, 1}, named());
    // The first intersection is at (508, 1.524) mm in the pattern. On the page, it is at
    // (origin_x_mm, origin_y_mm), relative to the corner.
    const std::string corner =
        fmt::format("x_mm {:.3f}, y_mm {:.3f}", 508 - sheet.origin_x_mm, 1.524 - sheet.origin_y_mm);
    EXPECT_THAT(content, HasSubstr("count from this corner, in the pattern " + corner));
    const Marks marks = marks_of(content, sheet.height_mm);
    ASSERT_TRUE(marks.texts_mm.contains("x") && marks.texts_mm.contains("y"));
    // Each letter is at the head of its arrow: x is to the right of y, and y is below x.
    EXPECT_GT(marks.texts_mm.at("x")[0], marks.texts_mm.at("y")[0] + 3);
    EXPECT_GT(marks.texts_mm.at("y")[1], marks.texts_mm.at("x")[1] + 3);
    // On a narrow page, the text is below the dots.
    options.paper = {80, 60};
    const std::string narrow = content_of_labels(make_sheet(options), {1, 1}, named());
    EXPECT_THAT(narrow, Not(HasSubstr("count from this")));
    EXPECT_THAT(narrow, HasSubstr("corner"));
    EXPECT_THAT(narrow, HasSubstr(fmt::format("{:.3f}", 508 - sheet.origin_x_mm)));
}

TEST(labels, stay_clear_of_the_dots) {
    for (const double margin_mm : {3.0, 5.0, 7.0, 10.0, 20.0}) {
        const Sheet sheet = make_sheet(small_page(margin_mm));
        const std::string content = content_of_labels(sheet, {1, 1}, named());
        const double reach_mm = sheet.pattern.displacement_mm + sheet.pattern.dot_mm / 2;
        const double mm_per_pt = 25.4 / 72;
        const double left = sheet.origin_x_mm - reach_mm;
        const double top = sheet.origin_y_mm - reach_mm;
        const double bottom =
            sheet.origin_y_mm + (sheet.rows - 1) * sheet.pattern.spacing_mm + reach_mm;
        std::istringstream lines(content);
        for (std::string line; std::getline(lines, line);) {
            double x = 0;
            double y = 0;
            const bool is_text =
                std::sscanf(line.c_str(), "%*d %*d %*d %*d %lf %lf Tm", &x, &y) == 2;
            if (!is_text && std::sscanf(line.c_str(), "%lf %lf m", &x, &y) != 2) continue;
            x *= mm_per_pt;
            y = sheet.height_mm - y * mm_per_pt;
            EXPECT_TRUE(x > 0 && y > 0 && y < sheet.height_mm) << line;
            // The position of a line of text is that of its baseline. Capitals extend 0.718 * 6 pt
            // = 1.52 mm above the baseline.
            EXPECT_TRUE(x < left || y < top || y > bottom + (is_text ? 1.52 : 0))
                << margin_mm << ": " << line;
        }
    }
}

TEST(labels, are_left_out_where_there_is_no_room) {
    const Sheet sheet = make_sheet(small_page(2));
    EXPECT_THAT(content_of_labels(sheet, {1, 1}, named()), Not(HasSubstr("Tj")));
    // This page has room for only one line of text, so the command is omitted.
    const Sheet wider = make_sheet(small_page(5));
    const std::string content = content_of_labels(wider, {1, 1}, named());
    EXPECT_THAT(content, HasSubstr("page 1 of 1"));
    EXPECT_THAT(content, Not(HasSubstr("dotpose print")));
}

TEST(labels, text_that_pdf_would_misread_is_escaped) {
    PrintOptions options = named();
    options.name = "a) Tj \\ \xc3\xa4";
    const std::string content = content_of_labels(make_sheet(small_page(10)), {1, 1}, options);
    EXPECT_THAT(content, HasSubstr("a\\) Tj \\\\"));
}

TEST(pdf, glyphs_need_whole_pixels) {
    const TemporaryDirectory directory;
    SheetOptions options = small_page(5);
    PrintOptions print;
    print.drawing = DotDrawing::glyphs;
    write_sheet(make_sheet(options), directory / "a.pdf", print);
    EXPECT_THAT(read_file(directory / "a.pdf"), testing::StartsWith("%PDF-"));
    options.pattern.spacing_mm = 0.5;
    EXPECT_THAT([&] { write_sheet(make_sheet(options), directory / "b.pdf", print); },
                ThrowsMessage<BadArgument>(HasSubstr("whole pixels")));
    print.drawing = DotDrawing::automatic;
    write_sheet(make_sheet(options), directory / "b.pdf", print);
    print.dpi = 1000;  // a spacing is 20 pixels, but a displacement is not a whole number of pixels
    write_sheet(make_sheet(options), directory / "c.pdf", print);
    EXPECT_EQ(directory.names(), (std::vector<std::string>{"a.pdf", "b.pdf", "c.pdf"}));
}

TEST(pdf, is_the_same_every_time) {
    const TemporaryDirectory directory;
    const std::vector<Sheet> sheets = make_sheets(small_page(10), 3);
    write_sheets(sheets, directory / "a.pdf", named());
    write_sheets(sheets, directory / "b.pdf", named());
    EXPECT_EQ(read_file(directory / "a.pdf"), read_file(directory / "b.pdf"));
}

TEST(pdf, several_pages_need_a_pdf) {
    const TemporaryDirectory directory;
    const std::vector<Sheet> sheets = make_sheets(small_page(5), 2);
    EXPECT_THAT([&] { write_sheets(sheets, directory / "a.png"); },
                ThrowsMessage<BadArgument>(HasSubstr("only a .pdf can hold several pages")));
    EXPECT_THROW(write_sheets({}, directory / "a.pdf"), BadArgument);
    EXPECT_TRUE(directory.names().empty());
}

TEST(pdf, stops_when_told_and_leaves_nothing) {
    const TemporaryDirectory directory;
    PrintOptions print;
    int max_rows = 0;
    print.progress = [&](int rows_done, int rows) {
        EXPECT_LE(rows_done, rows);
        max_rows = rows;
        return false;
    };
    SheetOptions options;
    options.paper = {841, 1189};
    EXPECT_THAT([&] { write_sheet(make_sheet(options), directory / "a.pdf", print); },
                ThrowsMessage<Error>(HasSubstr("stopped; nothing was written")));
    EXPECT_EQ(max_rows, make_sheet(options).rows);
    EXPECT_TRUE(directory.names().empty());
}

// qpdf requests the data of a stream again if the first request fails.
TEST(pdf, stops_with_the_first_error) {
    const TemporaryDirectory directory;
    PrintOptions print;
    int calls = 0;
    print.progress = [&](int, int) -> bool {
        throw std::runtime_error(fmt::format("error {}", ++calls));
    };
    EXPECT_THAT([&] { write_sheet(make_sheet({}), directory / "a.pdf", print); },
                ThrowsMessage<std::runtime_error>(HasSubstr("error 1")));
    calls = 0;
    print.progress = [&](int, int) { return ++calls > 1; };
    EXPECT_THAT([&] { write_sheet(make_sheet({}), directory / "a.pdf", print); },
                ThrowsMessage<Error>(HasSubstr("stopped; nothing was written")));
    EXPECT_TRUE(directory.names().empty());
}

}  // namespace
}  // namespace dotpose
