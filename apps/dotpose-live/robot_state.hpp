/// State of a robot, derived from the readings of `dotpose watch`.
#pragma once

#include <string>

#include "reading.hpp"
#include "state_message.hpp"

namespace dotpose::cli {

/// Returns the state message of a reading. `world_map` is the map name of the sheet file's world.
RobotState state_of(const Reading& reading, const std::string& robot, const std::string& world_map);

}  // namespace dotpose::cli
