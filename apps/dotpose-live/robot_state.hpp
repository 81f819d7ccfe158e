/// State messages of robots, in the style of VDA 5050, as JSON. docs/live.md describes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "frame_locator.hpp"

namespace dotpose::cli {

/// All robots' topics begin with it: KTopicRoot/ROBOT/state.
inline constexpr const char* kTopicRoot = "uagv/v2/dotpose";

/// Names that are longer than this many bytes are none.
inline constexpr std::size_t kMostNameBytes = 128;

std::string state_topic(const std::string& robot);
/// The robot whose state has this topic. Brokers grant topics, so it is the topic that says whose a
/// message is, whatever the message says. None if it is no topic of `state_topic`, or the name is
/// too long.
std::optional<std::string> robot_of(std::string_view topic);

struct RobotState {
    std::string robot;            ///< of the sender; empty in a message that was read
    std::uint64_t header_id = 0;  ///< counts the robot's messages
    std::int64_t sent_us = 0;     ///< system clock, since 1970
    std::string state = "lost";   ///< lost, moving, stationary
    std::string map_id;           ///< of the plane that x and y refer to
    bool is_localized = false;    ///< all below is valid
    double x_m = 0;
    double y_m = 0;
    double theta_rad = 0;
    double deviation_m = 0;
    double vx_m_s = 0;
    double vy_m_s = 0;
    double omega_rad_s = 0;
};

/// `world_map` names the world of the sheet file.
RobotState state_of(const Reading& reading, const std::string& robot, const std::string& world_map);

std::string json_of(const RobotState& state);

/// None if it is no such message, or its numbers are absurd.
std::optional<RobotState> parse_state(const std::string& json);

/// Microseconds since 1970.
std::int64_t system_us();

}  // namespace dotpose::cli
