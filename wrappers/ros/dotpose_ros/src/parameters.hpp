/// Parameters of the node, with defaults, ranges and descriptions.
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

/// The value of a parameter. The first alternative is a parameter without a value.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

struct Parameter {
    const char* name;
    Value standard;
    const char* description;
};

/// Returns all parameters of the node. They are read once, at its start.
std::span<const Parameter> parameters();

/// The options that result from the parameters.
struct Settings {
    dotpose::FollowerOptions follower;
    dotpose::ros::RobotFrames frames;
    std::int64_t half_exposure_ns = 0;
    bool has_camera_file = false;
    bool is_reliable = false;
    bool publishes_tf = true;
};

/// Reads the sheet file and the camera file, and checks all values. Integers are also accepted as
/// numbers. Throws dotpose::Error with the name of the parameter and its valid values.
Settings settings_of(const std::map<std::string, Value>& values);

}  // namespace dotpose_ros
