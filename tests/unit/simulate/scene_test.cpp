#include <algorithm>

#include <gtest/gtest.h>

#include "helpers.hpp"

namespace dotpose::simulate_test {
namespace {

// Returns a shot taken from straight above the grid, without imperfections. Columns and rows of
// cells are parallel to the columns and rows of the image.
Shot straight_shot() {
    Setup setup;
    setup.preset = Preset::clean;
    Shot shot = draw_shot(setup, 0);
    shot.pose.theta_rad = 0;
    shot.pose.fraction_x = 0.5;
    shot.pose.fraction_y = 0.5;
    shot.imperfections.blur_sigma_px = 0.5;
    return shot;
}

double dark_fraction(const GreyImage& image) {
    const auto dark =
        std::count_if(image.pixels.begin(), image.pixels.end(), [](int p) { return p < 115; });
    return static_cast<double>(dark) / static_cast<double>(image.pixels.size());
}

std::uint8_t at(const GreyImage& image, double u, double v) {
    return image.pixels[static_cast<std::size_t>(std::lround(v) * image.width_px + std::lround(u))];
}

TEST(Scene, EachIsAFrameOfItsOwn) {
    for (const Scene scene : kScenes) {
        SCOPED_TRACE(name(scene));
        Shot shot = straight_shot();
        const GreyImage image = render_scene(scene, shot);
        EXPECT_EQ(image.pixels.size(), 188u * 120u);
        EXPECT_EQ(image.pixels, render_scene(scene, shot).pixels);
        EXPECT_NE(image.pixels, render(shot).pixels);
    }
}

TEST(Scene, BlackAndWhiteAreEmpty) {
    const GreyImage black = render_scene(Scene::black, straight_shot());
    EXPECT_EQ(*std::max_element(black.pixels.begin(), black.pixels.end()), 0);
    const GreyImage white = render_scene(Scene::white, straight_shot());
    EXPECT_EQ(*std::min_element(white.pixels.begin(), white.pixels.end()), 200);
}

TEST(Scene, NoiseHasItsDensity) {
    EXPECT_NEAR(dark_fraction(render_scene(Scene::noise, straight_shot(), 0.1)), 0.1, 0.01);
    EXPECT_NEAR(dark_fraction(render_scene(Scene::noise, straight_shot(), 0.5)), 0.5, 0.02);
    EXPECT_THROW(render_scene(Scene::noise, straight_shot(), 1.5), BadArgument);
}

TEST(Scene, TextIsMostlyPaper) {
    const double fraction = dark_fraction(render_scene(Scene::text, straight_shot()));
    EXPECT_GT(fraction, 0.05);
    EXPECT_LT(fraction, 0.4);
}

TEST(Scene, CheckerboardIsHalfDark) {
    EXPECT_NEAR(dark_fraction(render_scene(Scene::checkerboard, straight_shot())), 0.5, 0.07);
}

TEST(Scene, PlainGridHasItsDotsOnTheIntersections) {
    const GreyImage image = render_scene(Scene::plain_grid, straight_shot());
    const double step_px = kDefaultSpacing_mm / 0.046;
    for (int j = -4; j < 4; ++j) {
        for (int i = -7; i < 7; ++i) {
            EXPECT_LT(at(image, 93.5 + (i + 0.5) * step_px, 59.5 + (j + 0.5) * step_px), 120);
        }
    }
}

TEST(Scene, ScatteredDotsHaveTheirDensity) {
    Shot shot = straight_shot();
    const double at_half =
        measure(render_scene(Scene::scattered_dots, shot, 0.5).pixels, 188, 200).mass;
    const double all = measure(render(shot).pixels, 188, 200).mass;
    EXPECT_NEAR(at_half / all, 0.5, 0.15);
}

TEST(Scene, MirroredIsThePatternReversed) {
    const Shot shot = straight_shot();
    GreyImage image = render_scene(Scene::mirrored, shot);
    for (int v = 0; v < 120; ++v) {
        const auto row = image.pixels.begin() + v * 188;
        std::reverse(row, row + 188);
    }
    EXPECT_EQ(image.pixels, render(shot).pixels);
}

TEST(Scene, ASeamJoinsTwoSectionsAtTheCentre) {
    Shot shot = straight_shot();
    const GreyImage one_section = render(shot);
    const GreyImage vertical = render_scene(Scene::seam_vertical, shot);
    const GreyImage horizontal = render_scene(Scene::seam_horizontal, shot);
    int right_differs = 0;
    int bottom_differs = 0;
    for (int v = 0; v < 120; ++v) {
        for (int u = 0; u < 188; ++u) {
            const std::uint8_t here = at(one_section, u, v);
            // Dots extend 1/4 spacing beyond their intersections, and farther if they are blurred.
            // Pixels near the seam are therefore not compared.
            if (u < 93) {
                ASSERT_EQ(at(vertical, u, v), here);
            }
            if (v < 59) {
                ASSERT_EQ(at(horizontal, u, v), here);
            }
            right_differs += u > 94 && at(vertical, u, v) != here ? 1 : 0;
            bottom_differs += v > 60 && at(horizontal, u, v) != here ? 1 : 0;
        }
    }
    EXPECT_GT(right_differs, 500);
    EXPECT_GT(bottom_differs, 500);
}

}  // namespace
}  // namespace dotpose::simulate_test
