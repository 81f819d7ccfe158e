/// Parameters: those of the node, with defaults, ranges and what they are for.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include <dotpose/tools/follower.hpp>
#include <dotpose/tools/robot_messages.hpp>

namespace dotpose_ros {

/// The value of a parameter. The first alternative is a parameter that is not set.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

struct Parameter {
    const char* name;
    Value standard;
    const char* description;
};

/// Returns all parameters of the node, which are read once, at its start.
std::span<const Parameter> parameters();

/// The values of the parameters.
struct Settings {
    dotpose::FollowerOptions follower;
    dotpose::ros::RobotFrames frames;
    std::int64_t half_exposure_ns = 0;
    bool has_camera_file = false;
    bool is_reliable = false;
    bool publishes_tf = true;
};

/// Reads sheet file and camera file, and checks all values; a whole number is a number too. Throws
/// dotpose::Error, which names the parameter and what is allowed.
Settings settings_of(const std::map<std::string, Value>& values);

}  // namespace dotpose_ros
