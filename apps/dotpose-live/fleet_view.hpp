/// Periodically shows the robots of a fleet, as a table and as a map.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "draw/track_map.hpp"
#include "fleet_report.hpp"
#include "fleet_state.hpp"

namespace dotpose::cli {

class FleetView {
  public:
    /// `sheets` is the path of the sheet file and `map` the path of the drawing. Both may be empty.
    /// Throws Error.
    FleetView(const std::string& sheets, std::string map, Delivery delivery);

    /// Shows the table if standard output is a terminal. Draws the map, but spends at most a tenth
    /// of the time on drawing.
    void refresh(const FleetState& fleet);

    /// Shows the last table and draws the last map. Throws Error if the map cannot be written.
    void finish(const FleetState& fleet);

  private:
    using Clock = std::chrono::steady_clock;

    void show_table(const FleetState& fleet) const;
    void draw(const FleetState& fleet);
    std::string map_shown(const FleetState& fleet) const;

    std::string map_path_;
    std::string map_id_;
    std::vector<draw::MapSheet> sheets_;
    Delivery delivery_;
    bool on_terminal_;
    bool is_failing_ = false;  ///< true if the last map could not be written
    Clock::time_point next_map_;
};

}  // namespace dotpose::cli
