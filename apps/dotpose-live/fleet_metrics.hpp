/// Metrics of a fleet in the text format of Prometheus, version 0.0.4. docs/fleet.md lists them.
#pragma once

#include <optional>
#include <string>

#include "fleet_report.hpp"
#include "fleet_state.hpp"
#include "store/queue.hpp"

namespace dotpose::cli {

/// Connections of `dotpose fleet`.
struct FleetServices {
    std::optional<bool> is_broker_connected;  ///< none without a broker
    Delivery delivery = Delivery::all;
    std::optional<store::QueueStatus> store;  ///< none without a database
};

/// Returns the metrics as text. `robots` is the result of `fleet.robots`. In the names of robots,
/// characters that the format reserves are escaped.
std::string metrics_text(const FleetState& fleet, const FleetRobots& robots, const FleetMap& map,
                         const FleetServices& services);

}  // namespace dotpose::cli
