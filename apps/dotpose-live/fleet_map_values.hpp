/// Values of the topics of the map on the page of `dotpose fleet --web`: positions and trails of
/// the robots in the part of the map that a client shows. The values are binary, because clients
/// receive positions up to 30 times a second. docs/fleet.md describes them.
#pragma once

#include <string>

#include "fleet_values.hpp"

namespace dotpose::cli {

/// Maximum number of points of all trails in a message.
inline constexpr std::size_t kMaxTrailPoints = 20'000;

/// Returns the robots in a part of a map. Arguments of the request: `map`, by default the map of
/// the sheet file or of the first robot; `x_min`, `x_max`, `y_min` and `y_max` in mm, by default
/// the whole map.
std::string positions_value(const FleetSnapshot& snapshot, const FleetMap& map,
                            const serve::Command& request);

/// Returns the trails of the same robots: the newest part of each path.
std::string trails_value(const FleetSnapshot& snapshot, const FleetState& fleet,
                         const FleetMap& map, const serve::Command& request);

}  // namespace dotpose::cli
