/// Values of the topics for the web page of `dotpose fleet --web`, except the map topics.
/// docs/fleet.md describes the topics. All names are printable (printable.hpp), and requests
/// identify robots by number.
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

/// Snapshot of the robots at one point in time, used for all clients.
struct FleetSnapshot {
    FleetRobots robots;  ///< sorted by name in natural order
    Now now;
};

/// Maximum number of rows that a client receives, even if the client requests more.
inline constexpr std::size_t kMaxTableRows = 200;

/// Maximum number of alerts that a client receives.
inline constexpr std::size_t kMaxAlerts = 200;

/// Returns the map, the sheets in the sheet file, and the time limits for `silent` and `gone`.
/// `device` is the name of the robot for `dotpose listen`, and is empty for a fleet. `has_history`
/// is true if the page can read stored states.
std::string setup_value(const FleetMap& map, const ConditionLimits& limits,
                        const std::string& device, bool has_history);

/// Returns the number of robots in each condition, the number of robots on each map, the message
/// counts, and the alerts. `alerts` must be sorted by time.
std::string summary_value(const FleetSnapshot& snapshot, const FleetState& fleet,
                          const FleetMap& map, const FleetServices& services, double states_per_s,
                          const std::deque<RobotAlert>& alerts);

/// Returns the requested rows of the table. The request has these arguments:
/// - `filter`: part of the name, state, reason, map or sheet,
/// - `show`: "all", "attention", "unknown" or the name of a condition,
/// - `order`: "attention", "name" or "place",
/// - `first` and `rows`: index of the first row, and number of rows.
std::string table_value(const FleetSnapshot& snapshot, const FleetMap& map, Delivery delivery,
                        const serve::Command& request);

/// Returns the newest state, the path and the alerts of a robot. The request's `robot` argument is
/// the number of the robot. Returns null if there is no such robot.
std::string robot_value(const FleetSnapshot& snapshot, const FleetState& fleet, const FleetMap& map,
                        Delivery delivery, const std::deque<RobotAlert>& alerts,
                        const serve::Command& request);

/// Returns the robot with the given number, or null if there is none.
const FleetEntry* robot_with(const FleetRobots& robots, double id);

}  // namespace dotpose::cli
