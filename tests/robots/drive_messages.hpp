/// Compares messages with the JSON lines that `dotpose watch --units ros` writes in the same run.
/// The messages are decoded by independent readers (npm_readers.hpp).
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "npm_readers.hpp"

namespace dotpose::test {

/// Maximum difference between a value in a message and the same value in a line. Lengths in lines
/// are rounded to nanometres, and angles to 1e-8 rad.
struct MessageTolerance {
    double length_m = 0.6e-9;
    double angle_rad = 1e-8;
    double speed_m_s = 0.6e-6;  ///< the lines are rounded to micrometres per second
    double turn_rad_s = 0.6e-6;
};
inline constexpr MessageTolerance kAsWatched;
/// Tolerance for messages that are converted from a log. In a log, angles in degrees have six
/// decimals, and velocities in mm/s and degrees/s have three.
inline constexpr MessageTolerance kAsLogged = {2e-9, 2e-8, 2e-6, 1e-5};

inline double yaw_of(const nlohmann::json& rotation) {
    return 2 * std::atan2(rotation["z"].get<double>(), rotation["w"].get<double>());
}

inline std::int64_t stamp_us(const nlohmann::json& header) {
    const nlohmann::json& stamp = header["stamp"];
    const auto nanoseconds =
        stamp[stamp.contains("nanosec") ? "nanosec" : "nsec"].get<std::int64_t>();
    return stamp["sec"].get<std::int64_t>() * 1'000'000 + nanoseconds / 1000;
}

inline std::int64_t time_us(const nlohmann::json& line) {
    return std::llround(line["t_s"].get<double>() * 1e6);
}

/// Expects one pose for each line that contains a fix. The pose must have the same values and the
/// same time as the line.
inline void expect_poses_of(const std::vector<nlohmann::json>& lines,
                            const std::vector<nlohmann::json>& poses,
                            const MessageTolerance& tolerance) {
    std::size_t next = 0;
    for (const nlohmann::json& line : lines) {
        if (line["status"] != "ok") continue;
        ASSERT_LT(next, poses.size()) << "poses are missing";
        const nlohmann::json& message = poses[next++]["message"];
        ASSERT_EQ(stamp_us(message["header"]), time_us(line));
        EXPECT_EQ(message["header"]["frame_id"], "map");
        const nlohmann::json& pose = message["pose"]["pose"];
        EXPECT_NEAR(pose["position"]["x"], line["x_m"].get<double>(), tolerance.length_m);
        EXPECT_NEAR(pose["position"]["y"], line["y_m"].get<double>(), tolerance.length_m);
        EXPECT_NEAR(std::remainder(yaw_of(pose["orientation"]) - line["yaw_rad"].get<double>(),
                                   2 * std::numbers::pi),
                    0, tolerance.angle_rad);
        const nlohmann::json& covariance = message["pose"]["covariance"];
        constexpr std::array<int, 3> kPlanar = {0, 1, 5};
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                const double value = line["covariance_m_rad"][3 * i + j];
                EXPECT_NEAR(covariance[static_cast<std::size_t>(6 * kPlanar[i] + kPlanar[j])],
                            value, 1e-6 * std::abs(value) + 1e-25);
            }
        }
        EXPECT_EQ(covariance[14], 1e6);
    }
    EXPECT_EQ(next, poses.size()) << "there are poses without a fix";
}

inline void expect_messages_of(const std::vector<nlohmann::json>& lines,
                               const std::vector<nlohmann::json>& messages,
                               const std::string& robot, const MessageTolerance& tolerance) {
    expect_poses_of(lines, of_topic(messages, '/' + robot + "/pose"), tolerance);
    const auto states = of_topic(messages, '/' + robot + "/status");
    const auto odometry = of_topic(messages, '/' + robot + "/odom");
    EXPECT_EQ(of_topic(messages, "/tf").size(), odometry.size());
    ASSERT_EQ(states.size(), lines.size());
    std::size_t next = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const nlohmann::json& line = lines[i];
        const nlohmann::json& status = states[i]["message"]["status"][0];
        ASSERT_EQ(stamp_us(states[i]["message"]["header"]), time_us(line));
        EXPECT_EQ(status["values"][0]["value"], line["state"]);
        EXPECT_EQ(status["values"][1]["value"], line["status"]);
        EXPECT_EQ(status["values"][2]["value"], line.value("events", ""));
        EXPECT_EQ(status["level"], line["state"] == "lost" ? 2 : line["status"] == "ok" ? 0 : 1);
        if (line["state"] == "lost") continue;
        ASSERT_LT(next, odometry.size());
        const nlohmann::json& odom = odometry[next++]["message"];
        ASSERT_EQ(stamp_us(odom["header"]), time_us(line));
        const nlohmann::json& linear = odom["twist"]["twist"]["linear"];
        const double speed = std::hypot(line["vx_m_s"].get<double>(), line["vy_m_s"].get<double>());
        EXPECT_NEAR(std::hypot(linear["x"].get<double>(), linear["y"].get<double>()), speed,
                    2 * tolerance.speed_m_s);
        EXPECT_NEAR(odom["twist"]["twist"]["angular"]["z"], line["turn_rad_s"].get<double>(),
                    tolerance.turn_rad_s);
    }
    EXPECT_EQ(next, odometry.size());
}

/// Expects that the product of the transforms from map to odom and from odom to base_link equals
/// the pose reported by the tracker. Also expects that the transform from odom to base_link is
/// continuous even when the robot jumps.
inline void expect_odometry_of(const std::vector<nlohmann::json>& lines,
                               const std::vector<nlohmann::json>& messages,
                               const std::string& robot) {
    const auto transforms = of_topic(messages, "/tf");
    ASSERT_EQ(transforms.size(), of_topic(messages, '/' + robot + "/odom").size());
    std::size_t next = 0;
    int jumps = 0;
    double before_x = 0;
    double before_y = 0;
    nlohmann::json map_before;
    for (const nlohmann::json& line : lines) {
        if (line["state"] == "lost") continue;
        const nlohmann::json& both = transforms.at(next++)["message"]["transforms"];
        const nlohmann::json& map = both[0]["transform"];
        const nlohmann::json& odom = both[1]["transform"];
        const double angle = yaw_of(map["rotation"]);
        const double x = odom["translation"]["x"];
        const double y = odom["translation"]["y"];
        EXPECT_NEAR(
            map["translation"]["x"].get<double>() + std::cos(angle) * x - std::sin(angle) * y,
            line["track_x_m"].get<double>(), 1e-9);
        EXPECT_NEAR(
            map["translation"]["y"].get<double>() + std::sin(angle) * x + std::cos(angle) * y,
            line["track_y_m"].get<double>(), 1e-9);
        // At the maximum speed of 300 mm/s, the robot moves by 1.5 mm between frames. The limit is
        // twice as large.
        EXPECT_LT(std::hypot(x - before_x, y - before_y), 0.003);
        if (map != map_before) ++jumps;
        map_before = map;
        before_x = x;
        before_y = y;
    }
    EXPECT_EQ(next, transforms.size());
    // The transform from map to odom jumps whenever the robot is found: at the start, after the
    // robot is put down, and after it is moved to the side.
    EXPECT_EQ(jumps, 3);
}

}  // namespace dotpose::test
