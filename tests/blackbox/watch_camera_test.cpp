// Tests that `dotpose watch --camera` reports the pose of the robot, like `dotpose locate
// --camera`.
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../drive.hpp"
#include "dotpose/files/camera_file.hpp"
#include "dotpose/tools/image_file.hpp"
#include "tool_command.hpp"

namespace dotpose::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr int kFrames = 8;
/// Index of the first frame that the test uses. In this frame, the robot is driving on the first
/// sheet.
constexpr int kMoving = 220;

class WatchCamera : public ToolCommand {
  protected:
    void SetUp() override {
        ToolCommand::SetUp();
        save_drive_sheets(directory_ / "sheets.json");
        const DriveCamera drive_camera(320, 240);
        const Drive drive;
        for (int i = 0; i < kFrames; ++i) {
            write_pgm(directory_ / ("f" + std::to_string(i) + ".pgm"),
                      drive_camera.frame(drive, kMoving + i).view());
        }
        Camera camera;
        camera.width_px = 320;
        camera.height_px = 240;
        camera.centre_px = {159.5, 119.5};
        camera.reference_px = PixelPoint{400, 90};
        camera.theta_offset_rad = std::numbers::pi / 6;
        write_camera(directory_ / "camera.yaml", camera);
    }

    std::vector<json> lines_of(const std::string& arguments) {
        EXPECT_EQ(run(arguments), 0) << errors_;
        std::vector<json> lines;
        std::istringstream stream(output_);
        for (std::string line; std::getline(stream, line);)
            lines.push_back(json::parse(line));
        return lines;
    }
};

TEST_F(WatchCamera, ThePoseIsThatOfTheRobot) {
    const auto located = lines_of("locate f*.pgm --sheets sheets.json --camera camera.yaml");
    const auto watched = lines_of(
        "watch 'f*.pgm' --fps 200 --max-speed 400 --sheets sheets.json --camera camera.yaml");
    const auto bare = lines_of("watch 'f*.pgm' --fps 200 --max-speed 400 --sheets sheets.json");
    ASSERT_EQ(located.size(), kFrames);
    ASSERT_EQ(watched.size(), kFrames);
    int tracked = 0;
    for (std::size_t i = 0; i < kFrames; ++i) {
        SCOPED_TRACE(testing::Message() << "frame " << i);
        ASSERT_EQ(watched[i]["status"], "ok");
        for (const char* key : {"x_sheet_mm", "y_sheet_mm"})
            EXPECT_NEAR(watched[i][key].get<double>(), located[i][key].get<double>(), 0.02);
        for (const char* key : {"x_m", "y_m"})
            EXPECT_NEAR(watched[i][key].get<double>(), located[i][key].get<double>(), 2e-5);
        EXPECT_NEAR(watched[i]["theta_deg"].get<double>(), located[i]["theta_deg"].get<double>(),
                    0.05);
        EXPECT_NEAR(
            std::remainder(
                watched[i]["theta_deg"].get<double>() - bare[i]["theta_deg"].get<double>(), 360),
            30, 0.05);
        tracked += watched[i]["attempt"] == "tracked" ? 1 : 0;
    }
    // The track contains the pose of the robot, but the prediction for the locator must be the pose
    // of the image centre. If this prediction were wrong, most frames would not be tracked.
    EXPECT_GE(tracked, kFrames - 3);
    EXPECT_NEAR(watched.back()["track_x_mm"].get<double>(),
                watched.back()["x_m"].get<double>() * 1000, 0.1);
    EXPECT_NEAR(watched.back()["track_y_mm"].get<double>(),
                watched.back()["y_m"].get<double>() * 1000, 0.1);
}

TEST_F(WatchCamera, FramesMustHaveTheSizeOfTheFile) {
    Camera camera;
    camera.width_px = 640;
    camera.height_px = 480;
    camera.centre_px = {319.5, 239.5};
    write_camera(directory_ / "other.yaml", camera);
    EXPECT_EQ(run("watch 'f*.pgm' --fps 200 --camera other.yaml"), 2);
    EXPECT_THAT(errors_, HasSubstr("640 x 480"));
}

}  // namespace
}  // namespace dotpose::test
