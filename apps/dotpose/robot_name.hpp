/// Options for the name of a robot and for the prefix of its coordinate frames, which appear in
/// MQTT topics and in ROS names.
#pragma once

#include <string>

namespace dotpose::cli {

class Command;

/// Adds --robot NAME. Rejects names that are not valid in topics.
void add_robot_option(Command& command, std::string& robot, const std::string& help);

/// Adds --frame-prefix PREFIX. The value is not validated here, but ros::with_prefix rejects
/// prefixes that are not valid in ROS.
void add_frame_prefix_option(Command& command, std::string& prefix);

}  // namespace dotpose::cli
