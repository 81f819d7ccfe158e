/// Metrics of a fleet in version 0.0.4 of the Prometheus text format. docs/fleet.md lists them.
#pragma once

#include <optional>
#include <string>

#include "fleet_report.hpp"
#include "fleet_state.hpp"
#include "store/queue.hpp"

namespace dotpose::cli {

/// State of the connections from `dotpose fleet` to the broker and the database.
struct FleetServices {
    std::optional<bool> is_broker_connected;  ///< nullopt if there is no broker
    Delivery delivery = Delivery::all;
    std::optional<store::QueueStatus> store;  ///< nullopt if there is no database
};

/// Returns the metrics as text. `robots` is the result of `fleet.robots`. Reserved characters in
/// robot names are escaped.
std::string metrics_text(const FleetState& fleet, const FleetRobots& robots, const FleetMap& map,
                         const FleetServices& services);

}  // namespace dotpose::cli
