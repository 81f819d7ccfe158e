/// What `dotpose fleet` shows of the robots: a table and a map.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "draw/track_map.hpp"
#include "fleet_state.hpp"

namespace dotpose::cli {

/// Whether a fleet gets all states of its robots. If it shares them with others, missing numbers
/// are no missing states, so these are not reported.
enum class Gets { all, share };

/// Returns a table of the robots as text, with a header line, and a line of what was counted.
std::string table_of(const FleetState& fleet, Gets gets, std::int64_t now_us);

/// Returns the map with the robots that are on it and its sheets.
draw::Map map_of(const FleetState& fleet, const std::string& map_id,
                 std::vector<draw::MapSheet> sheets);

}  // namespace dotpose::cli
