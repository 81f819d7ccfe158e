/// Options for robot names. These names are part of MQTT and ROS topics.
#pragma once

#include <string>

namespace dotpose::cli {

class Command;

/// Adds --robot NAME. The option rejects names that are not valid in topics.
void add_robot_option(Command& command, std::string& robot, const std::string& help);

/// Adds --frame-prefix PREFIX. ros::with_prefix rejects prefixes that are not valid in ROS.
void add_frame_prefix_option(Command& command, std::string& prefix);

}  // namespace dotpose::cli
