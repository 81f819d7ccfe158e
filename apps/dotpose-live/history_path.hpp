/// Builds a drawing of a robot's path from its stored states.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "draw/track_map.hpp"
#include "fleet_report.hpp"
#include "store/database.hpp"

namespace dotpose::cli {

class HistoryPath {
  public:
    /// `map` is the map to draw. If its id is empty, the map of the robot's first located state is
    /// drawn.
    explicit HistoryPath(FleetMap map) : map_(std::move(map)) {}

    /// Adds a state. States must be added in chronological order.
    void add(const store::State& state);

    /// Returns the map with the path, and with notes about the time span and about states on other
    /// maps.
    draw::Map drawing() const;

  private:
    /// Maximum number of points. `thin_out` is called when it is exceeded.
    static constexpr std::size_t kMaxPoints = 20'000;

    void thin_out();

    FleetMap map_;
    std::string robot_;
    std::string map_id_;
    std::int64_t first_us_ = 0;
    std::int64_t last_us_ = 0;
    bool begins_stroke_ = true;
    std::vector<std::vector<draw::Point>> strokes_mm_;
    std::size_t points_ = 0;
    double step_mm_ = 0.1;  ///< minimum distance between points
    store::State newest_;   ///< newest state on the map
    /// Number of states on each of the other maps (at most 20 maps).
    std::map<std::string, std::size_t> elsewhere_;
};

}  // namespace dotpose::cli
