#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/tools/print.hpp"
#include "files.hpp"

namespace dotpose {
namespace {

using print_test::TemporaryDirectory;
using testing::HasSubstr;

struct Point {
    double x_mm;
    double y_mm;
};

/// Returns the dots of one path. The path consists of relative moves from (0, 0), each followed by
/// a line of zero length: "mX Yh0".
std::vector<Point> dots_of(const std::string& path, double mm_per_unit) {
    std::istringstream stream(path);
    std::vector<Point> dots;
    double x = 0;
    double y = 0;
    for (char move = 0; stream >> move;) {
        double step_x = 0;
        double step_y = 0;
        char line = 0;
        double length = -1;
        stream >> step_x >> step_y >> line >> length;
        if (!stream.good() && !stream.eof()) ADD_FAILURE() << "cannot read a path";
        EXPECT_TRUE(move == 'm' && line == 'h' && length == 0) << "something else in a path";
        x += step_x;
        y += step_y;
        dots.push_back({x * mm_per_unit, y * mm_per_unit});
    }
    return dots;
}

std::vector<std::vector<Point>> dots_by_path(const std::string& svg, double mm_per_unit) {
    const std::string start = "<path d=\"";
    std::vector<std::vector<Point>> paths;
    for (std::size_t at = svg.find(start); at != std::string::npos; at = svg.find(start, at + 1)) {
        const std::size_t first = at + start.size();
        paths.push_back(dots_of(svg.substr(first, svg.find('"', first) - first), mm_per_unit));
    }
    return paths;
}

void expect_dots_where_they_belong(const SheetOptions& options) {
    const TemporaryDirectory directory;
    const Sheet sheet = make_sheet(options);
    write_sheet(sheet, directory / "sheet.svg");
    const std::string svg = print_test::read_file(directory / "sheet.svg");

    std::smatch size;
    ASSERT_TRUE(std::regex_search(svg, size,
                                  std::regex("width=\"([0-9.]+)mm\" height=\"([0-9.]+)mm\" "
                                             "viewBox=\"0 0 ([0-9.]+) ([0-9.]+)\"")));
    EXPECT_DOUBLE_EQ(std::stod(size[1]), options.paper.width_mm);
    EXPECT_DOUBLE_EQ(std::stod(size[2]), options.paper.height_mm);
    const double mm_per_unit = std::stod(size[1]) / std::stod(size[3]);
    EXPECT_NEAR(std::stod(size[2]) / std::stod(size[4]), mm_per_unit, 1e-12);

    std::smatch stroke;
    ASSERT_TRUE(std::regex_search(svg, stroke, std::regex("stroke-width=\"([0-9.]+)\"")));
    EXPECT_NEAR(std::stod(stroke[1]) * mm_per_unit, sheet.pattern.dot_mm, 1e-6);
    EXPECT_THAT(svg, HasSubstr("stroke=\"#000\""));
    EXPECT_THAT(svg, HasSubstr("stroke-linecap=\"round\""));

    const auto paths = dots_by_path(svg, mm_per_unit);
    ASSERT_EQ(paths.size(), static_cast<std::size_t>(sheet.rows));
    for (int j = 0; j < sheet.rows; ++j) {
        const auto& dots = paths[static_cast<std::size_t>(j)];
        ASSERT_EQ(dots.size(), static_cast<std::size_t>(sheet.columns));
        for (int i = 0; i < sheet.columns; ++i) {
            const Symbol symbol = symbol_at(sheet.pattern.code,
                                            {sheet.origin.x + static_cast<std::uint32_t>(i),
                                             sheet.origin.y + static_cast<std::uint32_t>(j)},
                                            sheet.pattern.section);
            const Pattern& pattern = sheet.pattern;
            const double x_mm =
                sheet.origin_x_mm + i * pattern.spacing_mm + dx(symbol) * pattern.displacement_mm;
            const double y_mm =
                sheet.origin_y_mm + j * pattern.spacing_mm + dy(symbol) * pattern.displacement_mm;
            const Point& dot = dots[static_cast<std::size_t>(i)];
            ASSERT_NEAR(dot.x_mm, x_mm, 0.0001) << i << " " << j;
            ASSERT_NEAR(dot.y_mm, y_mm, 0.0001) << i << " " << j;
        }
    }
}

TEST(write_svg, puts_every_dot_where_it_belongs) {
    SheetOptions options;
    options.paper = {.width_mm = 105, .height_mm = 60.25};
    options.origin = {.x = 4000, .y = 77};
    expect_dots_where_they_belong(options);
}

TEST(write_svg, does_not_add_up_rounding) {
    SheetOptions options;
    options.paper = {.width_mm = 300, .height_mm = 12};
    options.margin_mm = 0;
    options.pattern.spacing_mm = 0.3 + 1e-5 / 7;
    options.pattern.displacement_mm = 0.0471;
    options.pattern.dot_mm = 0.0613;
    expect_dots_where_they_belong(options);
}

}  // namespace
}  // namespace dotpose
