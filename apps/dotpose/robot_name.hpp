/// Names of robots, which brokers and ROS have in their topics.
#pragma once

#include <string>

namespace dotpose::cli {

class Command;

/// Adds --robot NAME, and refuses names that no topic can have.
void add_robot_option(Command& command, std::string& robot, const std::string& help);

/// Adds --frame-prefix PREFIX. ros::with_prefix refuses prefixes that ROS does not allow.
void add_frame_prefix_option(Command& command, std::string& prefix);

}  // namespace dotpose::cli
