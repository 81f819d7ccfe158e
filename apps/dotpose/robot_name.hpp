/// The --robot option sets the name of a robot, as it appears in MQTT topics and ROS names. The
/// --frame-prefix option sets the prefix of the robot's coordinate frames in ROS.
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
