/// Values of the map topics for the web page of `dotpose fleet --web`: positions and trails of the
/// robots in the part of the map that a client displays. The values are binary, because clients
/// receive positions up to 30 times per second. docs/fleet.md describes the format.
#pragma once

#include <string>

#include "fleet_values.hpp"

namespace dotpose::cli {

/// Maximum total number of trail points in a message, for all robots together.
inline constexpr std::size_t kMaxTrailPoints = 20'000;

/// Returns the robots in the requested part of a map. The request has the arguments `map` (default:
/// the map of the sheet file, or the map of the first robot), and `x_min`, `x_max`, `y_min` and
/// `y_max` in mm (default: the whole map).
std::string positions_value(const FleetSnapshot& snapshot, const FleetMap& map,
                            const serve::Command& request);

/// Returns the trails of the robots in the requested part of a map. A trail is the newest part of a
/// robot's path.
std::string trails_value(const FleetSnapshot& snapshot, const FleetState& fleet,
                         const FleetMap& map, const serve::Command& request);

}  // namespace dotpose::cli
