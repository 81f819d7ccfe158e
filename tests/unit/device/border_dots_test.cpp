// Tests that dots near the border of the image are found where they were drawn.
#include "device/border_dots.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "dotpose/tools/random.hpp"

namespace dotpose::core_test::border_dots_test {
namespace {

using namespace core;

constexpr int kSide_px = 36;

/// The tracking state of a device, with one stored image that shows dots on white paper.
class Drawn {
  public:
    Drawn() {
        tracking_.rows = rows_;
        tracking_.found = found_;
        tracking_.width_px = tracking_.height_px = kSide_px;
        tracking_.stride_px = kSide_px;
        tracking_.rows_taken = kSide_px;
        tracking_.min_contrast = 12;
        rows_.fill(200);
    }
    /// Draws a round blurred dot.
    void draw(double x_px, double y_px) {
        for (int v = 0; v < kSide_px; ++v) {
            for (int u = 0; u < kSide_px; ++u) {
                const double distance_px = std::hypot(u - x_px, v - y_px);
                const double depth = 110 * std::exp(-distance_px * distance_px / (2 * 0.7 * 0.7));
                std::uint8_t& pixel = rows_[static_cast<std::size_t>(v * kSide_px + u)];
                pixel = static_cast<std::uint8_t>(std::lround(pixel - depth));
            }
        }
    }
    std::span<const DetectedDot> border_dots() {
        tracking_.dots_measured = 0;
        find_border_dots(tracking_);
        return std::span(found_).first(static_cast<std::size_t>(tracking_.dots_measured));
    }

  private:
    std::array<std::uint8_t, kSide_px * kSide_px> rows_;
    std::array<DetectedDot, 96> found_;
    Tracking tracking_;
};

TEST(BorderDots, AreWhereTheyWereDrawn) {
    Rng rng(12);
    for (int round = 0; round < 400; ++round) {
        // The dot is close to the border along one axis and anywhere along the other.
        const double depth_px = rng.uniform(-0.4, 1.4);
        const double along_px = rng.uniform(-0.4, kSide_px - 0.6);
        const double across_px = round % 2 == 0 ? depth_px : kSide_px - 1 - depth_px;
        const double x_px = round % 4 < 2 ? across_px : along_px;
        const double y_px = round % 4 < 2 ? along_px : across_px;
        Drawn image;
        image.draw(x_px, y_px);
        const auto dots = image.border_dots();
        ASSERT_EQ(dots.size(), 1U) << x_px << ' ' << y_px;
        constexpr double kMiddle_px = (kSide_px - 1) / 2.0;
        EXPECT_NEAR(dots[0].centre_q8.x / 256.0 + kMiddle_px, x_px, 0.4) << y_px;
        EXPECT_NEAR(dots[0].centre_q8.y / 256.0 + kMiddle_px, y_px, 0.4) << x_px;
    }
}

TEST(BorderDots, DotsInTheMiddleAreLeftOut) {
    Drawn image;
    EXPECT_EQ(image.border_dots().size(), 0U);
    for (double at_px = 2; at_px < kSide_px - 2; at_px += 6)
        image.draw(at_px, 17);
    EXPECT_EQ(image.border_dots().size(), 0U);
    image.draw(35, 35);
    EXPECT_EQ(image.border_dots().size(), 1U);
}

}  // namespace
}  // namespace dotpose::core_test::border_dots_test
