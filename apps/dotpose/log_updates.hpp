/// Converts log rows written by `dotpose watch --log` to robot states, which are then converted to
/// ROS messages.
#pragma once

#include "dotpose/tools/robot_messages.hpp"
#include "run_log.hpp"

namespace dotpose::cli {

/// Returns the robot state in a row. Throws Error if the row is invalid.
ros::RobotUpdate update_of(const LogCells& row);

}  // namespace dotpose::cli
