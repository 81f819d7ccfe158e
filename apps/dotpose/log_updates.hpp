/// Reads what a log of `dotpose watch --log` tells of the robot, for messages of ROS.
#pragma once

#include "dotpose/tools/robot_messages.hpp"
#include "run_log.hpp"

namespace dotpose::cli {

/// Returns what a row tells. Throws Error if it is not valid.
ros::RobotUpdate update_of(const LogCells& row);

}  // namespace dotpose::cli
