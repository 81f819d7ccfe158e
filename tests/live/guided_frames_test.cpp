#include "guided_frames.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace dotpose::cli {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180;

/// A simulated robot whose frames are 100 ms apart.
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
    EXPECT_EQ(frames.gauge().text, "24 of 24 directions");
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
    // The robot rests, and then drives 0.1 mm per frame.
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

}  // namespace
}  // namespace dotpose::cli
