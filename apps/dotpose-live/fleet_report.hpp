/// Reports of `dotpose fleet`: a table of the robots and a map.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "draw/track_map.hpp"
#include "fleet_state.hpp"

namespace dotpose::cli {

/// Recipients of the states: this instance of `dotpose fleet` receives all states of its robots, or
/// several instances share the states. If the states are shared, another instance may have received
/// the states that are missing in the sequence numbers, so missing states are not reported.
enum class Delivery { all, shared };

/// The sheet file of a fleet.
struct FleetMap {
    std::string id;               ///< name of the map in the states; empty without a file
    std::set<std::string> names;  ///< names of all sheets
    std::vector<draw::MapSheet>
        outlines;  ///< outlines of the sheets that have a place in the world

    /// Returns false if the newest known place of the robot is on a map or sheet that is not in the
    /// file. Returns true if there is no file, or if the place is not known.
    bool has_place_of(const FleetRobot& robot) const;
};

using FleetEntry = std::pair<std::string, FleetRobot>;
using FleetRobots = std::vector<FleetEntry>;

/// Returns the name of the map to show: the world frame of the sheet file or, without a sheet file,
/// the map of the first robot that has one. Returns an empty string if there is none.
std::string shown_map(const FleetMap& map, const FleetRobots& robots);

/// Returns the rank of a robot by the attention that it needs, from 0 to 4: silent, lost, moving or
/// still on an unknown map or sheet, moving or still on a known one, gone.
int attention_rank(const FleetRobot& robot, const FleetMap& map);

/// Sorts the robots by `attention_rank`. Robots of equal rank keep their order.
void sort_by_attention(FleetRobots& robots, const FleetMap& map);

/// Columns of the table. `narrow` fits 80 characters and omits the counts of messages.
enum class Layout { wide, narrow };

/// Return the header and a row of the table, without a line break. The width is not limited,
/// because the place and the reason of the condition are not cut off.
std::string table_header(Layout layout);
std::string table_row(const std::string& name, const FleetRobot& robot, const FleetMap& map,
                      Layout layout, Delivery delivery);

/// Returns the number of robots in each condition and the counts of messages, as two lines, each
/// with a line break.
std::string summary_of(const FleetState& fleet, const FleetRobots& robots, const FleetMap& map,
                       Delivery delivery);

/// Returns the wide table of all robots by name, with a header line and the summary.
std::string table_of(const FleetState& fleet, const FleetMap& map, Delivery delivery,
                     const Now& now);

/// Returns the drawing of `map_id` with the robots on it and the sheets that they visited, or all
/// sheets if no sheet was visited. Robots on other maps are listed as notes.
draw::Map drawing_of(const FleetState& fleet, const std::string& map_id, const FleetMap& map,
                     const Now& now);

}  // namespace dotpose::cli
