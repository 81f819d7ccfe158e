/// Reports of `dotpose fleet`: a table and a map of the robots.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "draw/track_map.hpp"
#include "fleet_state.hpp"

namespace dotpose::cli {

/// How the broker delivers states. With `all`, this instance of `dotpose fleet` receives all states
/// of its robots. With `shared`, each state is delivered to only one of several instances. States
/// that appear to be missing may then have been delivered to another instance, so missing states
/// are not reported.
enum class Delivery { all, shared };

/// Contents of a fleet's sheet file.
struct FleetMap {
    std::string id;                        ///< name of the map, or empty if there is no sheet file
    std::set<std::string> names;           ///< names of all sheets
    std::vector<draw::MapSheet> outlines;  ///< outlines of the sheets that have a world pose

    /// Returns false if the last known position of the robot is on a map or sheet that is not in
    /// the file. Returns true if there is no file, or if no position is known.
    bool has_place_of(const FleetRobot& robot) const;
};

using FleetEntry = std::pair<std::string, FleetRobot>;
using FleetRobots = std::vector<FleetEntry>;

/// Returns the name of the map to display: the world frame of the sheet file or, without a sheet
/// file, the map of the first robot with a known position. Returns an empty string if no map is
/// known.
std::string shown_map(const FleetMap& map, const FleetRobots& robots);

/// Returns a rank that orders the robots by how urgently they need attention, most urgent first: 0
/// for silent, 1 for lost, 2 for moving or still on an unknown map or sheet, 3 for moving or still
/// on a known map and sheet, and 4 for gone.
int attention_rank(const FleetRobot& robot, const FleetMap& map);

/// Sorts the robots by `attention_rank`. The sort is stable.
void sort_by_attention(FleetRobots& robots, const FleetMap& map);

/// Columns of the table. `narrow` fits in 80 characters and omits the message counts.
enum class Layout { wide, narrow };

/// Return the header or one row of the table, without a line break. The reason, the map and the
/// sheet are not truncated, so the width of a row is not limited.
std::string table_header(Layout layout);
std::string table_row(const std::string& name, const FleetRobot& robot, const FleetMap& map,
                      Layout layout, Delivery delivery);

/// Returns two lines, each with a line break: the number of robots in each condition, and the
/// message counts.
std::string summary_of(const FleetState& fleet, const FleetRobots& robots, const FleetMap& map,
                       Delivery delivery);

/// Returns the wide table of all robots, sorted by name, with a header line and the summary.
std::string table_of(const FleetState& fleet, const FleetMap& map, Delivery delivery,
                     const Now& now);

/// Returns a drawing of the map `map_id`, with the robots on this map and the sheets that these
/// robots have visited, or with all sheets if none has been visited. The notes list up to 20 robots
/// on other maps.
draw::Map drawing_of(const FleetState& fleet, const std::string& map_id, const FleetMap& map,
                     const Now& now);

}  // namespace dotpose::cli
