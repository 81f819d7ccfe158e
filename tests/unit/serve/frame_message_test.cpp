#include "serve/frame_message.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../../temporary_directory.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/image_file.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose::serve {
namespace {

/// A frame message, parsed as the web page parses it.
struct Read {
    nlohmann::json head;
    GreyImage picture;
};

Read read(const std::string& message) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < 4; ++i)
        size |= static_cast<std::size_t>(static_cast<unsigned char>(message[i])) << 8 * i;
    const test::TemporaryDirectory folder;
    const auto path = folder.path() / "picture.jpg";
    std::ofstream(path, std::ios::binary) << message.substr(4 + size);
    return {nlohmann::json::parse(message.substr(4, size)), read_image(path)};
}

/// A located frame, and functions based on the true geometry of its camera.
struct Located {
    explicit Located(double k = 0) {
        Setup setup;
        setup.preset = Preset::clean;
        setup.camera.width_px = 376;
        setup.camera.height_px = 240;
        setup.camera.k = k;
        shot = draw_shot(setup, 4);
        shot.pose.theta_rad = 0.7;
        image = render(shot);
        DeviceOptions options;
        options.show_stages = true;
        options.lens.k_q40 = static_cast<std::int32_t>(std::lround(k * 0x1p40));
        Locator locator(options);
        fix = locator.locate(image.view());
        overlay = overlay_of(image.view(), locator.trace());
    }

    /// Returns the pattern point at a point on the overlay, in spacings relative to the cell of the
    /// pose.
    Vec2 pattern_point(draw::Point point) const {
        const Vec2 offset_mm =
            Projection(shot.camera, shot.pose).offset_from_pixel({point.x - 0.5, point.y - 0.5});
        const double spacing_mm = shot.page.pattern.spacing_mm;
        return {shot.pose.fraction_x + offset_mm.x / spacing_mm,
                shot.pose.fraction_y + offset_mm.y / spacing_mm};
    }

    Shot shot;
    GreyImage image;
    Fix fix;
    FrameOverlay overlay;
};

double distance_from_integer(double value) {
    return std::abs(value - std::round(value));
}

/// Requires that each line of the grid follows a row or column of intersections.
void require_grid_on_intersections(const Located& located) {
    ASSERT_EQ(located.fix.status, Status::ok);
    ASSERT_GT(located.overlay.grid.size(), 20U);
    for (const auto& line : located.overlay.grid) {
        double off_column = 0;
        double off_row = 0;
        for (const draw::Point& point : line) {
            const bool is_in_view = point.x > 0 && point.y > 0 &&
                                    point.x < located.image.width_px &&
                                    point.y < located.image.height_px;
            if (!is_in_view) continue;
            const Vec2 at = located.pattern_point(point);
            off_column = std::max(off_column, distance_from_integer(at.x));
            off_row = std::max(off_row, distance_from_integer(at.y));
        }
        EXPECT_LT(std::min(off_column, off_row), 0.03);
    }
}

TEST(OverlayOf, GridFollowsTheIntersections) {
    require_grid_on_intersections(Located());
}

TEST(OverlayOf, GridFollowsTheIntersectionsThroughALens) {
    require_grid_on_intersections(Located(-2e-6));
}

TEST(OverlayOf, DotsAreDisplacedFromTheIntersections) {
    const Located located;
    ASSERT_GT(located.overlay.dots.size(), 300U);
    for (const draw::Point& dot : located.overlay.dots) {
        // A dot is displaced along one axis by a sixth of the spacing.
        const Vec2 at = located.pattern_point(dot);
        const double x = distance_from_integer(at.x);
        const double y = distance_from_integer(at.y);
        EXPECT_NEAR(std::min(x, y), 0, 0.05);
        EXPECT_NEAR(std::max(x, y), 1.0 / 6, 0.05);
    }
}

TEST(OverlayOf, AxesPointAlongThePattern) {
    const Located located;
    ASSERT_TRUE(located.overlay.axes);
    const FrameOverlay::Axes& axes = *located.overlay.axes;
    EXPECT_NEAR(axes.at.x, 188, 0.01);
    EXPECT_NEAR(axes.at.y, 120, 0.01);
    // The image x axis is rotated by +0.7 rad in the pattern, so the pattern x axis is rotated by
    // -0.7 rad in the image.
    EXPECT_NEAR(axes.x.x, std::cos(-0.7), 0.01);
    EXPECT_NEAR(axes.x.y, std::sin(-0.7), 0.01);
    EXPECT_NEAR(axes.y.x, -std::sin(-0.7), 0.01);
    EXPECT_NEAR(axes.y.y, std::cos(-0.7), 0.01);
}

TEST(OverlayOf, FrameWithoutPatternHasNoAxes) {
    const GreyImage white{std::vector<std::uint8_t>(188 * 120, 255), 188, 120};
    DeviceOptions options;
    options.show_stages = true;
    Locator locator(options);
    EXPECT_NE(locator.locate(white.view()).status, Status::ok);
    const FrameOverlay overlay = overlay_of(white.view(), locator.trace());
    EXPECT_FALSE(overlay.axes);
    EXPECT_TRUE(overlay.grid.empty());
    EXPECT_TRUE(overlay.dots.empty());
}

TEST(FrameMessage, ContainsOverlayAndPicture) {
    const Located located;
    const Read read = serve::read(frame_message(located.image.view(), located.overlay, 41, 1000));
    EXPECT_EQ(read.head["frame"], 41);
    EXPECT_EQ(read.head["width_px"], 376);
    EXPECT_EQ(read.head["height_px"], 240);
    const auto& overlay = read.head["overlay"];
    ASSERT_EQ(overlay["dots"].size(), 2 * located.overlay.dots.size());
    EXPECT_NEAR(overlay["dots"][1], located.overlay.dots[0].y, 0.051);
    EXPECT_EQ(overlay["grid"].size(), located.overlay.grid.size());
    EXPECT_EQ(overlay["axes"].size(), 6U);
    ASSERT_EQ(read.picture.width_px, 376);
    // JPEG changes grey levels slightly.
    for (std::size_t i = 0; i < read.picture.pixels.size(); i += 97)
        EXPECT_NEAR(read.picture.pixels[i], located.image.pixels[i], 12);
}

TEST(FrameMessage, ReducesLargeFrames) {
    const Located located;
    const Read read = serve::read(frame_message(located.image.view(), located.overlay, 0, 200));
    EXPECT_EQ(read.head["width_px"], 376);
    EXPECT_EQ(read.picture.width_px, 188);
    EXPECT_EQ(read.picture.height_px, 120);
}

}  // namespace
}  // namespace dotpose::serve
