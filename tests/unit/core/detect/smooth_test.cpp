// Tests the filter that the second attempt applies, using drawn images.
#include "core/detect/smooth.hpp"

#include <gtest/gtest.h>

#include "../canvas.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core_test::smooth_test {
namespace {

using namespace core;

GreyImage smoothed(const GreyImage& image) {
    static LargeWorkspace workspace;
    Smoothing& smoothing = workspace.smoothing;
    begin_smoothing(image.view(), smoothing);
    GreyImage result{{}, image.width_px, image.height_px};
    for (int v = 0; v < image.height_px; ++v) {
        const std::uint8_t* row = next_smooth_row(image.view(), smoothing);
        result.pixels.insert(result.pixels.end(), row, row + image.width_px);
    }
    return result;
}

void expect_even(const GreyImage& image, int tolerance) {
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u) {
            ASSERT_NEAR(image.view().row(v)[u], kNormalLevel, tolerance) << u << ", " << v;
        }
    }
}

TEST(Smooth, AConstantImageStaysConstant) {
    for (const auto& [width, height] :
         {std::pair{64, 64}, std::pair{188, 120}, std::pair{301, 77}}) {
        for (const int level : {1, 20, 100, 200, 255}) {
            SCOPED_TRACE(testing::Message() << width << " x " << height << ", level " << level);
            expect_even(smoothed(blank(width, height, level)), 0);
        }
    }
}

TEST(Smooth, SinglePixelsVanish) {
    for (const int level : {0, 255}) {
        GreyImage image = blank(188, 120);
        pixel(image, 90, 60) = static_cast<std::uint8_t>(level);
        pixel(image, 1, 1) = static_cast<std::uint8_t>(level);
        pixel(image, 186, 50) = static_cast<std::uint8_t>(level);
        const GreyImage found = smoothed(image);
        for (int v = 0; v < 120; ++v) {
            for (int u = 0; u < 188; ++u) {
                // The bright pixel is 55 levels above the paper. It raises the mean of its
                // surroundings, which contain at least 5 x 5 pixels, by at most 55 / 25 levels.
                ASSERT_NEAR(found.view().row(v)[u], kNormalLevel, 3) << u << ", " << v;
            }
        }
        EXPECT_NEAR(found.view().row(60)[90], kNormalLevel, 1);
    }
    // Two adjacent pixels are not removed, because they are not an impulse.
    GreyImage image = blank(188, 120);
    fill(image, 90, 60, 92, 61, 0);
    EXPECT_LT(smoothed(image).view().row(60)[90], kNormalLevel - 30);
}

TEST(Smooth, DotsAreWeightedWithTheBinomial) {
    // A square of 3 x 3 pixels is wider than an impulse, so it remains. The square is an eighth
    // darker than the paper. At its middle pixel, the filter (1 4 6 4 1) / 16 along each axis
    // multiplies this difference by (14 / 16)^2.
    GreyImage image = blank(400, 400);
    fill(image, 199, 199, 202, 202, pixel(image, 0, 0) * 7 / 8);
    const GreyImage found = smoothed(image);
    EXPECT_NEAR(found.view().row(200)[200], kNormalLevel * (1 - 14.0 * 14 / 256 / 8), 2);
    EXPECT_NEAR(found.view().row(200)[202], kNormalLevel * (1 - 14.0 * 5 / 256 / 8), 2);
    EXPECT_NEAR(found.view().row(200)[204], kNormalLevel, 2);
}

TEST(Smooth, GraphicsAreNoDarkerThanAFifth) {
    GreyImage image = blank(188, 120);
    fill(image, 0, 50, 188, 66, 5);
    const GreyImage found = smoothed(image);
    for (int u = 0; u < 188; ++u) {
        ASSERT_EQ(found.view().row(58)[u], kNormalLevel * 4 / 5) << u;
        ASSERT_NEAR(found.view().row(30)[u], kNormalLevel, 2) << u;
    }
}

TEST(Smooth, AGradientOfTheLightBecomesEven) {
    for (const double angle : {0.0, 0.5, 1.57, 2.5, 4.0}) {
        SCOPED_TRACE(testing::Message() << "towards " << angle);
        GreyImage image = blank(188, 120);
        for (int v = 0; v < 120; ++v) {
            for (int u = 0; u < 188; ++u) {
                const double along = (u - 93.5) * std::cos(angle) + (v - 59.5) * std::sin(angle);
                pixel(image, u, v) = static_cast<std::uint8_t>(std::lround(160 + 0.6 * along));
            }
        }
        const GreyImage found = smoothed(image);
        for (int v = 4; v < 116; ++v) {
            for (int u = 4; u < 184; ++u) {
                ASSERT_NEAR(found.view().row(v)[u], kNormalLevel, 2) << u << ", " << v;
            }
        }
        // Larger errors are allowed within 4 px of the border, where part of the averaging window
        // is outside the image. The middle of the remaining part is up to 2 px from the filtered
        // pixel, so the light gradient biases the mean.
        expect_even(found, 5);
    }
}

TEST(Smooth, TheNextImageBeginsAfresh) {
    GreyImage dark = blank(188, 120, 10);
    fill(dark, 20, 20, 90, 90, 250);
    smoothed(dark);
    expect_even(smoothed(blank(100, 70, 90)), 0);
}

/// Smooths images of up to `max_width_px` x 4,096 px, and expects that each PaperMap fits into the
/// memory of the workspace.
void expect_paper_maps_fit(DesktopWorkspace& workspace, int max_width_px) {
    const PaperMap& map = workspace.smoothing.paper;
    // The block side is a tenth of the shorter side, rounded down, so the number of blocks is
    // largest just below a multiple of 10.
    for (int side = kMinFrameSide_px; side < 100; ++side) {
        for (const auto& [width, height] : {std::pair{max_width_px, side}, std::pair{side, 4096}}) {
            begin_smoothing(blank(width, height, 100).view(), workspace.smoothing);
            EXPECT_LE(map.rows * map.columns, static_cast<int>(map.levels.size())) << side;
            EXPECT_LE(map.rows * map.columns, static_cast<int>(map.brightest.size())) << side;
        }
    }
}

TEST(Smooth, PaperMapsOfLongImagesFitIntoTheMemory) {
    static LargeWorkspace large;
    expect_paper_maps_fit(large, 4096);
    // Regression: only the width of the images was limited in a small memory, but the memory for
    // the paper levels was not sufficient for images of 64 x 4096 px.
    static SmallWorkspace small;
    expect_paper_maps_fit(small, 188);
}

}  // namespace
}  // namespace dotpose::core_test::smooth_test
