#include "guided_frames.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "../pen_frames.hpp"
#include "dotpose/locate.hpp"

namespace dotpose::cli {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180;

/// A simulated robot whose camera takes a frame every 100 ms.
class Robot {
  public:
    GuidedFrame frame(double x_grid, double y_grid, double theta_rad = 0) {
        GuidedFrame frame;
        frame.fix.status = Status::ok;
        frame.fix.cell = {static_cast<std::uint32_t>(x_grid), static_cast<std::uint32_t>(y_grid)};
        frame.fix.fraction_x_q16 =
            static_cast<std::uint16_t>((x_grid - std::floor(x_grid)) * 65536);
        frame.fix.fraction_y_q16 =
            static_cast<std::uint16_t>((y_grid - std::floor(y_grid)) * 65536);
        const double half_turns =
            std::remainder(theta_rad, 2 * std::numbers::pi) / std::numbers::pi;
        frame.fix.theta_bam = static_cast<std::int32_t>(half_turns * 2147483647.0);
        frame.spacing_mm = 0.5;
        frame.index = index_++;
        frame.time_us = frame.index * 100'000;
        frame.image = {pixels_.data(), 4, 2, 4};
        return frame;
    }
    void drop_frame() { ++index_; }

  private:
    std::vector<std::uint8_t> pixels_ = std::vector<std::uint8_t>(8, 200);
    std::int64_t index_ = 0;
};

TEST(GuidedFrames, ATurnTakesOneFrameInEachDirection) {
    Robot robot;
    SpinFrames frames;
    for (int i = 0; i < 3 * 345; ++i) {
        ASSERT_FALSE(frames.is_complete()) << i;
        frames.take(robot.frame(100, 100, (179.9 - i / 3.0) * kDegree_rad));
    }
    frames.take(robot.frame(100, 100, -179 * kDegree_rad));
    EXPECT_TRUE(frames.is_complete());
    EXPECT_EQ(frames.images().size(), 24U);
    EXPECT_EQ(frames.images()[0]->width_px, 4);
    EXPECT_EQ(frames.gauges().at(0).text, "24 of 24 directions");
}

TEST(GuidedFrames, AnUnfinishedTurnIsNotComplete) {
    Robot robot;
    SpinFrames frames;
    for (int i = 0; i < 100; ++i)
        frames.take(robot.frame(100, 100, (1 + i) * kDegree_rad));
    EXPECT_FALSE(frames.is_complete());
    EXPECT_EQ(frames.images().size(), 7U);
}

TEST(GuidedFrames, ADriveTakesFramesAtEqualDistances) {
    Robot robot;
    DriveFrames frames;
    // The robot first rests, and then drives at 0.1 mm per frame.
    for (int i = 0; i < 50; ++i)
        frames.take(robot.frame(100, 100));
    EXPECT_EQ(frames.images().size(), 1U);
    int steps = 0;
    while (!frames.is_complete() && steps < 1000)
        frames.take(robot.frame(100 + 0.2 * ++steps, 100));
    EXPECT_NEAR(steps, 600, 20);
    EXPECT_NEAR(static_cast<double>(frames.images().size()), 41, 2);
}

TEST(GuidedFrames, AFastDriveTakesConsecutiveFrames) {
    Robot robot;
    ReadoutFrames frames;
    for (int i = 0; i < 40; ++i) {
        EXPECT_FALSE(frames.is_complete());
        frames.take(robot.frame(100 + 2 * i, 100));
    }
    EXPECT_TRUE(frames.is_complete());
    EXPECT_EQ(frames.images().size(), 40U);
    EXPECT_DOUBLE_EQ(frames.interval_ms(), 100);
}

TEST(GuidedFrames, AFastDriveStartsAgainAfterADroppedFrame) {
    Robot robot;
    ReadoutFrames frames;
    for (int i = 0; i < 10; ++i)
        frames.take(robot.frame(100 + 2 * i, 100));
    robot.drop_frame();
    frames.take(robot.frame(122, 100));
    EXPECT_EQ(frames.images().size(), 1U);
    EXPECT_EQ(frames.advice(), "frames were dropped: close other programs");
    for (int i = 0; i < 10; ++i)
        frames.take(robot.frame(124 + 2 * i, 100));
    frames.lose();
    EXPECT_EQ(frames.images().size(), 0U);
    EXPECT_FALSE(frames.is_complete());
}

TEST(GuidedFrames, AFastDriveEndsWhenTheRobotStops) {
    Robot robot;
    ReadoutFrames frames;
    frames.take(robot.frame(100, 100));
    frames.take(robot.frame(100.1, 100));
    EXPECT_EQ(frames.advice(), "drive faster");
    for (int i = 1; i < 20; ++i)
        frames.take(robot.frame(100 + 2 * i, 100));
    EXPECT_FALSE(frames.is_complete());
    frames.take(robot.frame(138.1, 100));
    EXPECT_TRUE(frames.is_complete());
    EXPECT_EQ(frames.images().size(), 20U);
}

constexpr double kFocal_px = 16 / 0.03;

/// Returns a frame taken by a tilted camera. The azimuth of the tilt is measured from the sheet's
/// +x axis towards its +y axis.
GuidedFrame leaning(Robot& robot, double tilt_deg, double azimuth_deg, double turn_deg = 0) {
    GuidedFrame frame = robot.frame(100, 100, turn_deg * kDegree_rad);
    const double per_px = std::tan(tilt_deg * kDegree_rad) / kFocal_px;
    const double angle_rad = (azimuth_deg - turn_deg) * kDegree_rad;
    frame.fix.pattern_from_image.perspective_q30 = {
        static_cast<std::int32_t>(std::lround(std::ldexp(per_px * std::cos(angle_rad), 30))),
        static_cast<std::int32_t>(std::lround(std::ldexp(per_px * std::sin(angle_rad), 30)))};
    return frame;
}

TEST(GuidedFrames, APivotTakesFramesWithDifferentTilts) {
    Robot robot;
    PivotFrames frames(kFocal_px);
    EXPECT_EQ(frames.needs().size(), 9U);
    for (int i = 0; i < 20; ++i)
        frames.take(leaning(robot, 0, 0, 10 * i));
    EXPECT_EQ(frames.images().size(), 1U);
    for (const double tilt_deg : {15.0, 25.0}) {
        for (int side = 0; side < 7; ++side)
            frames.take(leaning(robot, tilt_deg, 45 * side, 100));
    }
    EXPECT_EQ(frames.images().size(), 15U);
    EXPECT_FALSE(frames.directions()[7]);
    ASSERT_EQ(frames.needs().size(), 1U);
    EXPECT_EQ(frames.needs()[0], "tilt the pen towards the upper right corner of the sheet");
    EXPECT_EQ(frames.gauges().at(0).text, "7 of 8 directions");
    EXPECT_EQ(frames.gauges().at(1).text, "up to 25 degrees");
    EXPECT_FALSE(frames.is_complete());
    for (int i = 0; i < 16; ++i)
        frames.take(leaning(robot, i < 8 ? 20 : 32, 45 * i + 20));
    EXPECT_TRUE(frames.needs().empty());
    EXPECT_TRUE(frames.is_complete());
    EXPECT_EQ(frames.images().size(), 31U);
}

TEST(GuidedFrames, APivotWithSmallTiltsEnds) {
    Robot robot;
    PivotFrames frames(kFocal_px);
    for (int ring = 0; ring < 4; ++ring) {
        for (int i = 0; i < 60; ++i)
            frames.take(leaning(robot, 4 * ring, 6 * i));
    }
    EXPECT_FALSE(frames.is_complete());
    EXPECT_EQ(frames.needs().at(0), "tilt the pen farther, to 20 to 40 degrees");
}

TEST(GuidedFrames, TheTiltOfAFrameIsThatOfThePen) {
    Locator locator{DeviceOptions{}};
    Rng rng(7);
    for (std::uint64_t i = 0; i < 12; ++i) {
        const PenPose pose = test::pivoted(500, 700, 40 * kDegree_rad, rng);
        const GreyImage image = render(shot_of_pen(test::pen_shot(31, i), test::kTip, pose));
        const Fix fix = locator.locate(image.view());
        ASSERT_EQ(fix.status, Status::ok) << i;
        const PenLean lean = lean_in(fix, kFocal_px);
        EXPECT_NEAR(lean.x, std::tan(pose.tilt_rad) * std::cos(pose.azimuth_rad), 0.1) << i;
        EXPECT_NEAR(lean.y, std::tan(pose.tilt_rad) * std::sin(pose.azimuth_rad), 0.1) << i;
    }
}

}  // namespace
}  // namespace dotpose::cli
