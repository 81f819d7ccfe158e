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

/// Value of a parameter. std::monostate means that the parameter has no value.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

struct Parameter {
    const char* name;
    Value standard;
    const char* description;
};

/// Returns all parameters of the node. Their values are read only once, when the node starts.
std::span<const Parameter> parameters();

/// Settings of the node, determined by its parameters.
struct Settings {
    dotpose::FollowerOptions follower;
    dotpose::ros::RobotFrames frames;
    std::int64_t half_exposure_ns = 0;
    bool has_camera_file = false;
    bool is_reliable = false;
    bool publishes_tf = true;
};

/// Reads the sheet file and the camera file, and checks all values. Integers are accepted for
/// floating-point parameters. Throws dotpose::Error with the name of the parameter and its valid
/// values.
Settings settings_of(const std::map<std::string, Value>& values);

}  // namespace dotpose_ros
