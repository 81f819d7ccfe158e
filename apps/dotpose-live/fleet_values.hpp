/// Values of the topics of the page of `dotpose fleet --web`, except those of the map.
/// docs/fleet.md describes them. All names are printable (printable.hpp), and requests refer to
/// robots by number.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <string>

#include "fleet_metrics.hpp"
#include "fleet_report.hpp"
#include "serve/command.hpp"
#include "state_message.hpp"

namespace dotpose::cli {

/// The robots at one time, shared by the values of all clients.
struct FleetSnapshot {
    FleetRobots robots;  ///< in natural order
    Now now;
};

/// Maximum number of rows that a client receives, whatever it requests.
inline constexpr std::size_t kMaxTableRows = 200;

/// Maximum number of alerts that a client receives.
inline constexpr std::size_t kMaxAlerts = 200;

/// Returns the map, the sheets of the sheet file, and the limits of the conditions. `device` is the
/// name of the robot of `dotpose listen`, or empty for a fleet. `has_history` is true if the page
/// can read stored states.
std::string setup_value(const FleetMap& map, const ConditionLimits& limits,
                        const std::string& device, bool has_history);

/// Returns the number of robots by state and map, the counts of messages, and the alerts. `alerts`
/// must be sorted by time.
std::string summary_value(const FleetSnapshot& snapshot, const FleetState& fleet,
                          const FleetMap& map, const FleetServices& services, double states_per_s,
                          const std::deque<RobotAlert>& alerts);

/// Returns the requested rows of the table. Arguments of the request: `filter`, a part of the name,
/// state, reason, map or sheet; `show`, one of "all", "attention", "unknown" and the names of the
/// conditions; `order`, one of "attention", "name" and "place"; `first` and `rows`.
std::string table_value(const FleetSnapshot& snapshot, const FleetMap& map, Delivery delivery,
                        const serve::Command& request);

/// Returns the newest state, the path and the alerts of the robot with the number `robot`, or null
/// if there is no such robot.
std::string robot_value(const FleetSnapshot& snapshot, const FleetState& fleet, const FleetMap& map,
                        Delivery delivery, const std::deque<RobotAlert>& alerts,
                        const serve::Command& request);

/// Returns the robot with a number, or null.
const FleetEntry* robot_with(const FleetRobots& robots, double id);

}  // namespace dotpose::cli
