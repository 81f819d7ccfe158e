// Tests `dotpose locate --pose space`.
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../tilted_shot.hpp"
#include "locate_command.hpp"

namespace dotpose::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kDegree_rad = std::numbers::pi / 180;
constexpr double kDistance_mm = kTiltedDistance_mm;

class LocateSpace : public LocateCommand {
  protected:
    /// Writes a frame taken by a camera that is tilted by 20 degrees towards +x, and the camera
    /// file for this camera.
    void SetUp() override {
        shot_ = tilted_shot();
        write_pgm(directory_ / "frame.pgm", render(shot_).view());
        write_camera("camera.yaml", "focal_px: 543.4782609\n");
    }
    void write_camera(const std::string& name, const std::string& more) {
        std::ofstream(directory_ / name)
            << "format: dotpose-camera\nversion: 1\nwidth_px: 320\nheight_px: 240\n"
               "k_per_px2: 0\ncentre_px: [159.5, 119.5]\n"
            << more;
    }
    Shot shot_;
};

TEST_F(LocateSpace, WritesPositionAndAngles) {
    ASSERT_EQ(run("--camera camera.yaml --pose space frame.pgm"), 0) << errors_;
    const json line = json::parse(output_);
    // `x_mm` and `y_mm` refer to the point at which the optical axis intersects the paper. The
    // camera is kDistance_mm from this point, along a line that is tilted by kTilt_deg from the
    // vertical.
    const double aside_mm = kDistance_mm * std::sin(kTilt_rad);
    EXPECT_NEAR(line["camera_x_mm"], line["x_mm"].get<double>() + aside_mm, 0.05);
    EXPECT_NEAR(line["camera_y_mm"], line["y_mm"].get<double>(), 0.05);
    EXPECT_NEAR(line["camera_z_mm"], -kDistance_mm * std::cos(kTilt_rad), 0.05);
    EXPECT_NEAR(line["camera_tilt_deg"], kTilt_deg, 0.1);
    EXPECT_NEAR(line["camera_azimuth_deg"], 0, 0.3);
    EXPECT_NEAR(line["camera_turn_deg"], 0, 0.3);
    // The camera is rotated about the y axis of the paper by -20 degrees.
    const json& q = line["camera_quaternion_xyzw"];
    EXPECT_NEAR(q[1], -std::sin(kTilt_deg / 2 * kDegree_rad), 0.002);
    EXPECT_NEAR(q[3], std::cos(kTilt_deg / 2 * kDegree_rad), 0.001);
    EXPECT_EQ(line["camera_covariance_mm_deg"].size(), 36U);
    EXPECT_EQ(line["camera_is_ambiguous"], false);
    EXPECT_FALSE(line.contains("warning"));
}

TEST_F(LocateSpace, PointsUpInTheUnitsOfRos) {
    ASSERT_EQ(run("--camera camera.yaml --pose space --units ros frame.pgm"), 0) << errors_;
    const json line = json::parse(output_);
    EXPECT_NEAR(line["camera_z_pattern_m"], 0.025 * std::cos(kTilt_rad), 5e-5);
    EXPECT_NEAR(line["camera_y_pattern_m"], line["y_pattern_m"].get<double>(), 5e-5);
    EXPECT_FALSE(line.contains("camera_z_mm"));
}

TEST_F(LocateSpace, IsInTextAndInBriefCsv) {
    ASSERT_EQ(run("--camera camera.yaml --pose space --format text frame.pgm"), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("; camera x "));
    EXPECT_THAT(output_, HasSubstr("tilt "));
    ASSERT_EQ(run("--camera camera.yaml --pose space --format csv frame.pgm"), 0) << errors_;
    const auto columns = cells_of(lines_of(output_).at(0));
    EXPECT_THAT(columns, Contains("camera_z_mm"));
    EXPECT_THAT(columns, Not(Contains("camera_covariance_mm_deg_00")));
    EXPECT_EQ(cells_of(lines_of(output_).at(1)).size(), columns.size());
    ASSERT_EQ(run("--camera camera.yaml frame.pgm"), 0) << errors_;
    EXPECT_THAT(output_, Not(HasSubstr("camera_")));
}

TEST_F(LocateSpace, IsRefusedWithoutAFocalLength) {
    EXPECT_EQ(run("--pose space frame.pgm"), 2);
    EXPECT_THAT(errors_, HasSubstr("--pose space needs --camera FILE"));
    write_camera("flat.yaml", "");
    EXPECT_EQ(run("--camera flat.yaml --pose space frame.pgm"), 1);
    EXPECT_THAT(errors_, HasSubstr("flat.yaml: the camera file has no focal_px"));
    EXPECT_THAT(errors_, HasSubstr("tilted"));
}

TEST_F(LocateSpace, WarnsIfTheMirroredTiltIsPossible) {
    // At a focal length of 20,000 px, the perspective is too weak to determine the direction of the
    // tilt.
    dotpose::Setup setup;
    setup.camera.working_distance_mm = 20'000 * setup.camera.mm_per_px;
    setup.seed = 21;
    Shot shot = draw_shot(setup, 0);
    shot.pose.tilt_x_rad = 8 * kDegree_rad;
    write_pgm(directory_ / "far.pgm", render(shot).view());
    std::ofstream(directory_ / "far.yaml")
        << "format: dotpose-camera\nversion: 1\nwidth_px: 188\nheight_px: 120\n"
           "k_per_px2: 0\ncentre_px: [93.5, 59.5]\nfocal_px: 20000\n";
    ASSERT_EQ(run("--camera far.yaml --pose space far.pgm"), 0) << errors_;
    const json line = json::parse(output_);
    EXPECT_EQ(line["camera_is_ambiguous"], true);
    EXPECT_GT(line["camera_second_odds"].get<double>(), 1e-9);
    EXPECT_EQ(line["camera_second_quaternion_xyzw"].size(), 4U);
    EXPECT_THAT(line["warning"].get<std::string>(), HasSubstr("second pose"));
}

TEST_F(LocateSpace, ReadsTheCamerasOfRos) {
    std::ofstream(directory_ / "info.yaml")
        << "image_width: 320\nimage_height: 240\ncamera_matrix: {rows: 3, cols: 3, data: "
           "[543.4782609, 0, 159.5, 0, 543.4782609, 119.5, 0, 0, 1]}\n"
           "distortion_model: plumb_bob\ndistortion_coefficients: {rows: 1, cols: 5, data: "
           "[0, 0, 0, 0, 0]}\n";
    ASSERT_EQ(run("--camera info.yaml --pose space frame.pgm"), 0) << errors_;
    const json line = json::parse(output_);
    EXPECT_NEAR(line["camera_tilt_deg"], kTilt_deg, 0.1);
    EXPECT_NEAR(line["camera_z_mm"], -kDistance_mm * std::cos(kTilt_rad), 0.05);
}

}  // namespace
}  // namespace dotpose::test
