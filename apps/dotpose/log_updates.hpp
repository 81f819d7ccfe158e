/// Converts log rows to robot states, from which ROS messages are made. The logs are written by
/// `dotpose watch --log`.
#pragma once

#include "dotpose/tools/robot_messages.hpp"
#include "run_log.hpp"

namespace dotpose::cli {

/// Returns the robot state in a row. Throws Error if the row is invalid.
ros::RobotUpdate update_of(const LogCells& row);

}  // namespace dotpose::cli
