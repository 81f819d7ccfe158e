/// Frames taken by a tilted camera over a sheet whose pose in the world is known, and the true
/// camera poses.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "drive.hpp"

namespace dotpose::test {

inline constexpr double kSpaceDistance_mm = 25;
inline constexpr double kSpaceFps = 10;  ///< frame rate at which the tests play the frames
/// Tilt of the camera in each frame. The camera leans towards +x.
inline constexpr std::array kSpaceTilts_rad = {0.1, 0.25, 0.4, 0.55};

/// Writes the raw video space.raw, which contains the frames, and the camera file camera.yaml.
inline void write_space_frames(const std::filesystem::path& folder) {
    const Sheet sheet = drive_sheets().front().sheet;
    CameraModel camera;
    camera.width_px = 320;
    camera.height_px = 240;
    camera.working_distance_mm = kSpaceDistance_mm;
    std::ofstream raw(folder / "space.raw", std::ios::binary);
    for (std::size_t i = 0; i < kSpaceTilts_rad.size(); ++i) {
        CameraPose pose;
        pose.cell = {sheet.origin.x + 100 + static_cast<std::uint32_t>(i), sheet.origin.y + 200};
        pose.tilt_y_rad = kSpaceTilts_rad[i];
        const GreyImage image = render(page_of(sheet), camera, pose, DriveCamera::nominal(), 1 + i);
        raw.write(reinterpret_cast<const char*>(image.pixels.data()),
                  static_cast<std::streamsize>(image.pixels.size()));
    }
    std::ofstream(folder / "camera.yaml")
        << "format: dotpose-camera\nversion: 1\nwidth_px: 320\nheight_px: 240\n"
           "k_per_px2: 0\ncentre_px: [159.5, 119.5]\nmm_per_px: [0.046, 0.046]\nfocal_px: "
        << kSpaceDistance_mm / camera.mm_per_px << '\n';
}

/// Returns the true position of the camera in the world, in m. The optical axis intersects the
/// paper at the cell that `write_space_frames` sets. The origin of the world is the lower left
/// corner of the first sheet, which is 297 mm high.
inline Eigen::Vector3d true_space_position(std::size_t frame) {
    const Sheet sheet = drive_sheets().front().sheet;
    const double mm = sheet.pattern.spacing_mm;
    const double tilt_rad = kSpaceTilts_rad[frame];
    return Eigen::Vector3d(sheet.origin_x_mm + (100 + static_cast<double>(frame)) * mm +
                               kSpaceDistance_mm * std::sin(tilt_rad),
                           297 - sheet.origin_y_mm - 200 * mm,
                           kSpaceDistance_mm * std::cos(tilt_rad)) /
           1000;
}

/// Returns the true rotation from the optical frame to the world: the camera looks straight down,
/// and is then rotated about the y axis of the world by the tilt.
inline Eigen::Quaterniond true_space_rotation(std::size_t frame) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(kSpaceTilts_rad[frame], Eigen::Vector3d::UnitY()) *
                              Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()));
}

/// Expects that the position and rotation of a geometry_msgs/Pose or Transform match the true pose
/// of a frame, and that the error is consistent with `covariance`.
inline void expect_true_space_pose(std::size_t frame, const nlohmann::json& position,
                                   const nlohmann::json& rotation,
                                   const nlohmann::json& covariance) {
    const Eigen::Vector3d at(position["x"], position["y"], position["z"]);
    const Eigen::Quaterniond seen(rotation["w"].get<double>(), rotation["x"].get<double>(),
                                  rotation["y"].get<double>(), rotation["z"].get<double>());
    EXPECT_NEAR(seen.norm(), 1, 1e-8);
    // The covariance refers to (x, y, z) and a rotation vector about the axes of the world.
    const Eigen::AngleAxisd turn(true_space_rotation(frame) * seen.conjugate());
    Eigen::Matrix<double, 6, 1> error;
    error << true_space_position(frame) - at,
        std::remainder(turn.angle(), 2 * std::numbers::pi) * turn.axis();
    EXPECT_LT(error.head<3>().norm(), 5e-5);
    EXPECT_LT(error.tail<3>().norm(), 2e-3);
    Eigen::Matrix<double, 6, 6> variances;
    for (int i = 0; i < 36; ++i)
        variances(i / 6, i % 6) = covariance[static_cast<std::size_t>(i)].get<double>();
    EXPECT_LT(error.dot(variances.ldlt().solve(error)), 30);
}

/// Expects the odometry to contain the true camera poses. For the last image, also expects the true
/// linear and angular velocities, in camera coordinates.
inline void expect_true_camera_odometry(const std::vector<nlohmann::json>& odometry) {
    ASSERT_EQ(odometry.size(), kSpaceTilts_rad.size());
    for (std::size_t i = 0; i < odometry.size(); ++i) {
        EXPECT_EQ(odometry[i]["header"]["frame_id"], "map");
        EXPECT_EQ(odometry[i]["child_frame_id"], "camera_optical");
        const nlohmann::json& pose = odometry[i]["pose"]["pose"];
        expect_true_space_pose(i, pose["position"], pose["orientation"],
                               odometry[i]["pose"]["covariance"]);
    }
    const std::size_t last = kSpaceTilts_rad.size() - 1;
    const nlohmann::json& twist = odometry[last]["twist"]["twist"];
    const auto vector_of = [](const nlohmann::json& v) {
        return Eigen::Vector3d(v["x"], v["y"], v["z"]);
    };
    const Eigen::Vector3d velocity_m_s =
        (true_space_position(last) - true_space_position(last - 1)) * kSpaceFps;
    const Eigen::Vector3d seen_m_s = true_space_rotation(last) * vector_of(twist["linear"]);
    EXPECT_LT((seen_m_s - velocity_m_s).norm(), 0.15 * velocity_m_s.norm());
    // The camera rotates about the y axis of the world, which is the negative y axis of the image.
    const double turn_rad_s = (kSpaceTilts_rad[last] - kSpaceTilts_rad[last - 1]) * kSpaceFps;
    EXPECT_LT((vector_of(twist["angular"]) - Eigen::Vector3d(0, -turn_rad_s, 0)).norm(), 0.2);
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_GT(odometry[last]["twist"]["covariance"][7 * i], 0);
}

/// Expects that the messages from a run contain the true poses of all frames.
inline void expect_true_space_poses(const std::vector<nlohmann::json>& messages) {
    std::vector<nlohmann::json> poses;
    std::vector<nlohmann::json> transforms;
    std::vector<nlohmann::json> odometry;
    for (const nlohmann::json& message : messages) {
        EXPECT_NE(message["topic"], "/tf_static");
        if (message["topic"] == "/anna/camera_pose") poses.push_back(message["message"]);
        if (message["topic"] == "/anna/camera_odom") odometry.push_back(message["message"]);
        if (message["topic"] != "/tf") continue;
        const nlohmann::json& camera = message["message"]["transforms"].back();
        EXPECT_EQ(camera["header"]["frame_id"], "map");
        EXPECT_EQ(camera["child_frame_id"], "camera_optical");
        transforms.push_back(camera["transform"]);
    }
    ASSERT_EQ(poses.size(), kSpaceTilts_rad.size());
    ASSERT_EQ(transforms.size(), kSpaceTilts_rad.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        EXPECT_EQ(poses[i]["header"]["frame_id"], "map");
        const nlohmann::json& pose = poses[i]["pose"]["pose"];
        const nlohmann::json& covariance = poses[i]["pose"]["covariance"];
        expect_true_space_pose(i, pose["position"], pose["orientation"], covariance);
        expect_true_space_pose(i, transforms[i]["translation"], transforms[i]["rotation"],
                               covariance);
    }
    expect_true_camera_odometry(odometry);
}

}  // namespace dotpose::test
