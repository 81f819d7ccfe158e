#include <cstdio>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/tools/print.hpp"
#include "files.hpp"
#include "print/pdf_labels.hpp"

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

TEST(labels, say_what_is_on_the_page) {
    SheetOptions options = small_page(10);
    options.origin = {300, 500};
    options.pattern.section = {4, 62};
    const Sheet sheet = make_sheet(options);
    const std::string content = print::label_content(sheet, {2, 3}, named());
    EXPECT_THAT(content, HasSubstr("door"));
    EXPECT_THAT(content, HasSubstr("page 2 of 3"));
    EXPECT_THAT(content, HasSubstr("cells 300,500 to"));
    EXPECT_THAT(content, HasSubstr("section 4,62"));
    EXPECT_THAT(content, HasSubstr("dotpose print -o door.pdf"));
    EXPECT_THAT(content, HasSubstr("0 0 0 1 k 0 0 0 1 K"));
    EXPECT_THAT(content, HasSubstr("(0 mm) Tj"));
    // The dots span 79.756 mm, so that is where the ruler ends.
    EXPECT_THAT(content, HasSubstr("(70) Tj"));
    EXPECT_THAT(content, Not(HasSubstr("(80) Tj")));
}

/// Bottom edge and top edge of the page, without margins: every position that text or a tick has.
TEST(labels, stay_clear_of_the_dots) {
    for (const double margin_mm : {3.0, 5.0, 7.0, 10.0, 20.0}) {
        const Sheet sheet = make_sheet(small_page(margin_mm));
        const std::string content = print::label_content(sheet, {1, 1}, named());
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
            // Text below begins under its capitals, 0.718 * 6 pt = 1.52 mm high.
            EXPECT_TRUE(x < left || y < top || y > bottom + (is_text ? 1.52 : 0))
                << margin_mm << ": " << line;
        }
    }
}

TEST(labels, are_left_out_where_there_is_no_room) {
    const Sheet sheet = make_sheet(small_page(2));
    EXPECT_THAT(print::label_content(sheet, {1, 1}, named()), Not(HasSubstr("Tj")));
    const Sheet wider = make_sheet(small_page(5));  // one line, so no command
    const std::string content = print::label_content(wider, {1, 1}, named());
    EXPECT_THAT(content, HasSubstr("page 1 of 1"));
    EXPECT_THAT(content, Not(HasSubstr("dotpose print")));
}

TEST(labels, text_that_pdf_would_misread_is_escaped) {
    PrintOptions options = named();
    options.name = "a) Tj \\ \xc3\xa4";
    const std::string content = print::label_content(make_sheet(small_page(10)), {1, 1}, options);
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
    print.dpi = 1000;  // 20 pixels, but a third of a pixel in the displacement
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
    int most_rows = 0;
    print.progress = [&](int rows_done, int rows) {
        EXPECT_LE(rows_done, rows);
        most_rows = rows;
        return false;
    };
    SheetOptions options;
    options.paper = {841, 1189};
    EXPECT_THAT([&] { write_sheet(make_sheet(options), directory / "a.pdf", print); },
                ThrowsMessage<Error>(HasSubstr("stopped; nothing was written")));
    EXPECT_EQ(most_rows, make_sheet(options).rows);
    EXPECT_TRUE(directory.names().empty());
}

}  // namespace
}  // namespace dotpose
