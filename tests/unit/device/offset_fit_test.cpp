// Tests that the fit recovers the affine map that displaces the dots.
#include "device/offset_fit.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "dotpose/tools/random.hpp"

namespace dotpose::core_test::offset_fit_test {
namespace {

using namespace core;

DetectedDot dot_at(double x_px, double y_px) {
    return {{static_cast<std::int32_t>(std::lround(256 * x_px)),
             static_cast<std::int32_t>(std::lround(256 * y_px))},
            60,
            0};
}

TEST(OffsetFit, RemovesAffineOffsets) {
    Rng rng(8);
    for (int round = 0; round < 200; ++round) {
        // Alternates between small views with 28 dots and views of about 196 px with 400 dots. The
        // offsets are less than an eighth of a cell.
        const double half_px = round % 2 == 0 ? 16 : 97;
        const int dots = round % 2 == 0 ? 28 : 400;
        const double slope = 0.1 / half_px / 3;
        const std::array<double, 6> truth{rng.uniform(-0.02, 0.02),   rng.uniform(-0.02, 0.02),
                                          rng.uniform(-slope, slope), rng.uniform(-slope, slope),
                                          rng.uniform(-slope, slope), rng.uniform(-slope, slope)};
        OffsetFit fit;
        for (int i = 0; i < dots; ++i) {
            const DetectedDot dot =
                dot_at(rng.uniform(-half_px, half_px / 2), rng.uniform(-half_px, half_px));
            const double x = dot.centre_q8.x / 256.0;
            const double y = dot.centre_q8.y / 256.0;
            fit.add(dot, {static_cast<std::int32_t>(
                              std::lround(16777216 * (truth[0] + truth[2] * x + truth[4] * y))),
                          static_cast<std::int32_t>(
                              std::lround(16777216 * (truth[1] + truth[3] * x + truth[5] * y)))});
        }
        EXPECT_EQ(fit.count(), dots);
        PlaneFromImage plane{};
        ASSERT_TRUE(fit.correct(plane));
        EXPECT_NEAR(plane.at_centre_q16.x / 65536.0, -truth[0], 1e-3) << round;
        EXPECT_NEAR(plane.at_centre_q16.y / 65536.0, -truth[1], 1e-3) << round;
        EXPECT_NEAR(plane.du_q24.x / 16777216.0 * half_px, -truth[2] * half_px, 1e-3) << round;
        EXPECT_NEAR(plane.du_q24.y / 16777216.0 * half_px, -truth[3] * half_px, 1e-3) << round;
        EXPECT_NEAR(plane.dv_q24.x / 16777216.0 * half_px, -truth[4] * half_px, 1e-3) << round;
        EXPECT_NEAR(plane.dv_q24.y / 16777216.0 * half_px, -truth[5] * half_px, 1e-3) << round;
    }
}

TEST(OffsetFit, DotsOnALineDetermineNothing) {
    OffsetFit fit;
    for (int i = 0; i < 12; ++i)
        fit.add(dot_at(i, 0.5 * i), {1 << 20, 0});
    PlaneFromImage plane{};
    EXPECT_FALSE(fit.correct(plane));
    EXPECT_EQ(plane.at_centre_q16, FixedVec{});
}

}  // namespace
}  // namespace dotpose::core_test::offset_fit_test
