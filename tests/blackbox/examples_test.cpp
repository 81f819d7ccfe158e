// Tests the example programs, run as shown in README.md and docs/tracking.md.
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../drive.hpp"
#include "../paths.hpp"
#include "dotpose/tools/image_file.hpp"
#include "sheets_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;

class Examples : public ToolCommand {
  protected:
    /// Runs an example. The examples are in the same folder as the tool.
    int run_example(const std::string& command) {
        return shell("\"$(dirname \"$T\")\"/dotpose_" + command);
    }
};

TEST(Readme, HasTheProgramOfTheExample) {
    const std::string readme = read_file(test::source_dir() + "/README.md");
    const std::string example = read_file(test::source_dir() + "/examples/locate_one.cpp");
    // README.md omits the first line of the example, which is a comment.
    EXPECT_THAT(readme, HasSubstr("```cpp\n" + example.substr(example.find('\n') + 1) + "```\n"));
}

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
    // The robot's camera takes 200 frames per second. The robot drives at 300 mm/s and is then
    // lifted.
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
        // The tracker can estimate the velocity only after the second frame. Without the velocity,
        // the prediction is too far from the true pose, so only the third and later frames are
        // tracked.
        EXPECT_EQ(lines[i].ends_with("tracked"), i >= 2) << lines[i];
        const DriveState truth = drive.at(first + static_cast<int>(i));
        if (i >= 4) {
            EXPECT_NEAR(std::hypot(vx, vy), std::hypot(truth.vx_mm_s, truth.vy_mm_s), 3);
        }
    }
    EXPECT_EQ(lines.back(), "lost");
}

TEST_F(Examples, FollowSheetsTellsSheetPlaceAndSpeed) {
    ASSERT_EQ(ToolCommand::run("print -o table.svg --paper 80x60 --sheets s.json --name table"), 0)
        << errors_;
    const json sheet = json::parse(read_file(directory_ / "s.json"))["sheets"].at(0);
    // The robot moves by 1 mm per frame, at 100 frames per second.
    for (int i = 0; i < 10; ++i) {
        const std::string name = "f" + std::to_string(100 + i) + ".pgm";
        const auto seed = static_cast<std::uint64_t>(i);
        write_pgm(directory_ / name, frame_of(sheet, 30.0 + i, 25, 0.5, seed).view());
    }
    ASSERT_EQ(run_example("follow_sheets s.json 100 f*.pgm"), 0) << errors_;
    const auto lines = lines_of(output_);
    ASSERT_EQ(lines.size(), 10U);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        double x_mm = 0;
        double y_mm = 0;
        double angle_rad = 0;
        double mm_per_s = 0;
        ASSERT_EQ(
            std::sscanf(lines[i].c_str(), "table: x %lf mm, y %lf mm, angle %lf rad, %lf mm/s",
                        &x_mm, &y_mm, &angle_rad, &mm_per_s),
            4)
            << lines[i];
        EXPECT_NEAR(x_mm, 30.0 + static_cast<double>(i), 0.02);
        EXPECT_NEAR(y_mm, 25, 0.02);
        EXPECT_NEAR(angle_rad, 0.5, 0.005);
        if (i >= 5) {
            EXPECT_NEAR(mm_per_s, 100, 3);
        }
    }
}

TEST_F(Examples, EndWithAMessageIfAFileIsMissing) {
    ToolCommand::run("print -o table.svg --paper 80x60 --sheets s.json --name table");
    for (const char* command :
         {"locate_one missing.pgm", "follow_robot 200 missing.pgm missing.pgm",
          "follow_sheets missing.json 100 missing.pgm", "follow_sheets s.json 100 missing.pgm",
          "device_packets missing.pgm", "opencv_video missing.mp4"}) {
        EXPECT_EQ(run_example(command), 1) << command;
        EXPECT_THAT(errors_, HasSubstr("missing.")) << command;
    }
}

TEST_F(Examples, SayHowTheyAreUsed) {
    for (const char* name :
         {"locate_one", "follow_robot", "follow_sheets", "device_packets", "opencv_video"}) {
        EXPECT_EQ(run_example(name), 2) << name;
        EXPECT_THAT(errors_, HasSubstr("usage: ")) << name;
    }
}

TEST_F(Examples, DevicePacketsAreThoseThatListenReads) {
    for (int i = 0; i < 3; ++i) {
        write_pgm(directory_ / ("f" + std::to_string(i) + ".pgm"),
                  render(shot(static_cast<std::uint64_t>(i))).view());
    }
    ASSERT_EQ(run_example("device_packets f0.pgm f1.pgm f2.pgm > p.bin"), 0) << errors_;
    ASSERT_EQ(ToolCommand::run("listen p.bin"), 0) << errors_;
    const auto lines = lines_of(output_);
    ASSERT_EQ(lines.size(), 3U) << output_;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const json record = json::parse(lines[i]);
        EXPECT_EQ(record["status"], "ok");
        EXPECT_NEAR(record["x_grid"], x_grid(shot(i).pose), 0.03);
        EXPECT_NEAR(record["y_grid"], y_grid(shot(i).pose), 0.03);
    }
}

TEST_F(Examples, OpencvVideoLocatesEachFrame) {
    for (int i = 0; i < 3; ++i) {
        write_pgm(directory_ / ("f" + std::to_string(i) + ".pgm"),
                  render(shot(static_cast<std::uint64_t>(i))).view());
    }
    // OpenCV opens a series of numbered images as a video.
    ASSERT_EQ(run_example("opencv_video f%d.pgm"), 0) << errors_;
    const auto lines = lines_of(output_);
    ASSERT_EQ(lines.size(), 3U) << output_;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        double x_mm = 0;
        ASSERT_EQ(std::sscanf(lines[i].c_str(), "x %lf mm", &x_mm), 1) << lines[i];
        EXPECT_NEAR(x_mm, x_grid(shot(i).pose) * kDefaultSpacing_mm, 0.015);
    }
}

}  // namespace
}  // namespace dotpose::test
