#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../temporary_directory.hpp"
#include "../../xml_check.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/draw.hpp"

namespace dotpose {
namespace {

using test::XmlCheck;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

SheetEntry entry(const std::string& name, std::optional<WorldPose> world) {
    SheetEntry result;
    result.name = name;
    result.sheet.width_mm = 100;
    result.sheet.height_mm = 50;
    result.world = world;
    return result;
}

std::string drawn(const std::vector<SheetEntry>& sheets) {
    const test::TemporaryDirectory directory;
    const std::filesystem::path path = directory.path() / "map.svg";
    draw_sheets(path, sheets);
    std::ifstream stream(path);
    return {std::istreambuf_iterator<char>(stream), {}};
}

using Corner = std::array<double, 2>;

/// Returns the corners of all sheets in the drawing, in the order of the file.
std::vector<std::array<Corner, 4>> outlines(const std::string& svg) {
    const std::string start = R"(<polygon class="sheet" points=")";
    std::vector<std::array<Corner, 4>> result;
    for (std::size_t at = svg.find(start); at != std::string::npos; at = svg.find(start, at + 1)) {
        std::istringstream numbers(svg.substr(at + start.size()));
        char comma = 0;
        for (auto& [x, y] : result.emplace_back())
            numbers >> x >> comma >> y;
    }
    return result;
}

void expect_step(Corner from, Corner to, double right, double down) {
    EXPECT_NEAR(to[0] - from[0], right, 0.02);
    EXPECT_NEAR(to[1] - from[1], down, 0.02);
}

TEST(sheet_map, shows_every_sheet_where_it_lies_with_y_up) {
    const std::string svg = drawn({entry("straight", WorldPose{0, 0, 0}),
                                   entry("turned", WorldPose{0.2, 0.1, std::numbers::pi / 2})});
    EXPECT_THAT(XmlCheck(svg).problem(), IsEmpty());
    const auto found = outlines(svg);
    ASSERT_EQ(found.size(), 2U);
    const auto& [straight, turned] = std::array{found[0], found[1]};
    const double per_m = (straight[1][0] - straight[0][0]) / 0.1;
    EXPECT_GT(per_m, 1000);
    // The corners are in clockwise order, starting at the top left, so the steps go right, down and
    // left.
    expect_step(straight[0], straight[1], 0.1 * per_m, 0);
    expect_step(straight[1], straight[2], 0, 0.05 * per_m);
    expect_step(straight[2], straight[3], -0.1 * per_m, 0);
    // This page is rotated by 90 degrees counter-clockwise. Its upper edge points up, so the page
    // is to the right of this edge.
    expect_step(straight[0], turned[0], 0.2 * per_m, -0.1 * per_m);
    expect_step(turned[0], turned[1], 0, -0.1 * per_m);
    expect_step(turned[1], turned[2], 0.05 * per_m, 0);
    EXPECT_THAT(svg, HasSubstr(">straight</text>"));
    EXPECT_THAT(svg, HasSubstr(">turned</text>"));
    EXPECT_THAT(svg, Not(HasSubstr("Without a pose")));
    // The length of the scale bar is two fifths of the box width, rounded down to 1, 2 or 5 times a
    // power of ten. The box is 0.25 m wide, so the bar is 0.1 m long.
    EXPECT_THAT(svg, HasSubstr(">100 mm</text>"));
    EXPECT_THAT(svg, HasSubstr(R"(class="axis")"));
}

TEST(sheet_map, shows_sheets_without_a_pose_beside_the_world) {
    const std::string svg = drawn({entry("drawer", {}), entry("table", WorldPose{1, 2, 0.3}),
                                   entry("a & b", {}), entry("c", {}), entry("d", {})});
    EXPECT_THAT(XmlCheck(svg).problem(), IsEmpty());
    EXPECT_THAT(svg, HasSubstr("Without a pose"));
    EXPECT_THAT(svg, HasSubstr(">a &amp; b</text>"));
    EXPECT_THAT(svg, HasSubstr(">100 x 50 mm</text>"));
    const auto found = outlines(svg);
    ASSERT_EQ(found.size(), 5U);
    const std::array<Corner, 4>& world = found[0];
    for (std::size_t i = 1; i < found.size(); ++i) {
        for (const Corner corner : world)
            EXPECT_GT(found[i][0][0], corner[0]) << i;
        // The width of the page is twice its height.
        expect_step(found[i][0], found[i][2], found[i][1][0] - found[i][0][0],
                    (found[i][1][0] - found[i][0][0]) / 2);
        for (std::size_t j = 1; j < i; ++j)
            EXPECT_NE(found[i][0], found[j][0]) << "one over the other";
    }
    // The origin is two metres away. If the map contained the origin, the page, which is 0.1 m
    // wide, would be too small to be visible.
    EXPECT_THAT(svg, Not(HasSubstr(R"(class="axis")")));
}

TEST(sheet_map, without_any_pose_says_what_is_missing) {
    const std::string svg = drawn({entry("drawer", {})});
    EXPECT_THAT(XmlCheck(svg).problem(), IsEmpty());
    EXPECT_THAT(svg, HasSubstr("dotpose sheets place"));
    EXPECT_EQ(outlines(svg).size(), 1U);
    EXPECT_THAT(XmlCheck(drawn({})).problem(), IsEmpty());
}

TEST(sheet_map, refuses_what_is_farther_apart_than_can_be_drawn) {
    for (const double far_m : {1e9, 1e308}) {
        EXPECT_THROW(
            drawn({entry("a", WorldPose{-far_m, 0, 0}), entry("b", WorldPose{far_m, 0, 0})}), Error)
            << far_m;
    }
}

}  // namespace
}  // namespace dotpose
