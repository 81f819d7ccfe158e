// The small examples, run as README.md and docs/tracking.md show them.
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../drive.hpp"
#include "dotpose/tools/image_file.hpp"
#include "locate_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;

class Examples : public ToolCommand {
  protected:
    /// The examples lie beside the tool.
    int run_example(const std::string& command) {
        return shell("\"$(dirname \"$T\")\"/dotpose_" + command);
    }
};

TEST_F(Examples, LocateOneTellsWhereAnImageLooks) {
    const Shot truth = shot(0);
    write_pgm(directory_ / "a.pgm", render(truth).view());
    ASSERT_EQ(run_example("locate_one a.pgm"), 0);
    double x_mm = 0;
    double y_mm = 0;
    ASSERT_EQ(std::sscanf(output_.c_str(), "x %lf mm, y %lf mm", &x_mm, &y_mm), 2) << output_;
    EXPECT_NEAR(x_mm, x_grid(truth.pose) * kDefaultSpacing_mm, 0.015);
    EXPECT_NEAR(y_mm, y_grid(truth.pose) * kDefaultSpacing_mm, 0.015);
}

TEST_F(Examples, FollowGoesWithTheRobot) {
    // At 300 mm/s, 200 frames a second; then it is lifted.
    const Drive drive;
    const DriveCamera camera(188, 120);
    const int first = static_cast<int>(drive.plan().lift * kDriveFps) - 12;
    for (int i = 0; i < 30; ++i) {
        const std::string name = "f" + std::to_string(100 + i) + ".pgm";
        write_pgm(directory_ / name, camera.frame(drive, first + i).view());
    }
    ASSERT_EQ(run_example("follow_robot 200 f*.pgm"), 0);
    const auto lines = lines_of(output_);
    ASSERT_EQ(lines.size(), 30U);
    for (std::size_t i = 0; i < 12; ++i) {
        double vx = 0;
        double vy = 0;
        ASSERT_EQ(std::sscanf(lines[i].c_str(), "x %*f mm, y %*f mm, %lf and %lf mm/s", &vx, &vy),
                  2)
            << lines[i];
        // Two fixes make a velocity; before, it moves too far from frame to frame.
        EXPECT_THAT(lines[i], HasSubstr(i < 2 ? "first" : "tracked"));
        const DriveState truth = drive.at(first + static_cast<int>(i));
        if (i >= 4) {
            EXPECT_NEAR(std::hypot(vx, vy), std::hypot(truth.vx_mm_s, truth.vy_mm_s), 3);
        }
    }
    EXPECT_EQ(lines.back(), "lost");
}

}  // namespace
}  // namespace dotpose::test
