/// Reports of `dotpose fleet`: a table of the robots and a map.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "draw/track_map.hpp"
#include "fleet_state.hpp"

namespace dotpose::cli {

/// Recipients of the states: this instance of `dotpose fleet` receives all states of its robots, or
/// several instances share the states. If the states are shared, a gap in the sequence numbers does
/// not mean a lost state, so missing states are not reported.
enum class Delivery { all, shared };

/// Returns a table of the robots as text, with a header line and a summary line.
std::string table_of(const FleetState& fleet, Delivery delivery, std::int64_t now_us);

/// Returns the map with its sheets and the robots on it.
draw::Map map_of(const FleetState& fleet, const std::string& map_id,
                 std::vector<draw::MapSheet> sheets);

}  // namespace dotpose::cli
