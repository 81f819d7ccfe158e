/// State messages of robots as JSON in the style of VDA 5050. docs/live.md describes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dotpose::cli {

/// Prefix of the topics of all robots, which are kTopicRoot/ROBOT/state.
inline constexpr const char* kTopicRoot = "uagv/v2/dotpose";

/// Value of `connectionState` in the message that a broker sends for a robot whose connection
/// broke, as VDA 5050 has it.
inline constexpr const char* kBroken = "CONNECTIONBROKEN";

/// Longest name of a robot; topics with longer names are ignored.
inline constexpr std::size_t kMostNameBytes = 128;

std::string state_topic(const std::string& robot);
/// Returns the robot whose states have this topic. Brokers grant rights by topic, so the sender is
/// taken from the topic and not from the message. Returns none if `state_topic` does not make this
/// topic, or if the name is too long. The name is a part of the topic.
std::optional<std::string_view> robot_of(std::string_view topic);

struct RobotState {
    std::string robot;            ///< name of the sender; empty in a message that was parsed
    std::uint64_t header_id = 0;  ///< counts the robot's messages
    std::int64_t sent_us = 0;     ///< microseconds since 1970, system clock of the sender
    std::string state = "lost";   ///< lost, moving, stationary
    std::string map_id;           ///< name of the plane that x and y refer to
    bool is_localized = false;    ///< whether the members below are valid
    double x_m = 0;
    double y_m = 0;
    double theta_rad = 0;
    double deviation_m = 0;
    double vx_m_s = 0;
    double vy_m_s = 0;
    double omega_rad_s = 0;
    /// Whether this is the last will: the broker sends it when the robot's connection breaks.
    bool is_will = false;
};

std::string json_of(const RobotState& state);

/// Parses a state message. Returns none if it is not valid or its numbers are out of range.
std::optional<RobotState> parse_state(std::string_view json);

/// Returns the system time in microseconds since 1970.
std::int64_t system_us();

}  // namespace dotpose::cli
