/// State of a robot, derived from the readings of `dotpose watch`.
#pragma once

#include <string>

#include "reading.hpp"
#include "state_message.hpp"

namespace dotpose::cli {

/// Returns the state message for a reading. `world_map` is the name of the map for poses in the
/// world frame of the sheet file.
RobotState state_of(const Reading& reading, const std::string& robot, const std::string& world_map);

}  // namespace dotpose::cli
