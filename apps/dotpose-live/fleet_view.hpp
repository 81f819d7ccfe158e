/// Periodically shows the robots of a fleet, as a table and as a map.
#pragma once

#include <chrono>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

#include "fleet_page.hpp"
#include "fleet_report.hpp"
#include "fleet_state.hpp"
#include "terminal_screen.hpp"

namespace dotpose::cli {

/// Reads a sheet file. Returns an empty map if the path is empty. Throws Error if the file cannot
/// be read.
FleetMap read_fleet_map(const std::string& sheets);

class FleetView {
  public:
    /// `drawing` is the path of the drawing, or empty for no drawing. Throws Error if it cannot be
    /// written.
    FleetView(FleetMap map, std::string drawing, Delivery delivery);

    /// Takes the pressed keys, and shows the table if a key was pressed. Returns false if the user
    /// wants to end the program.
    bool take_keys(const FleetState& fleet, const Now& now);

    /// Shows the table if standard output is a terminal. Draws the map, unless this would take more
    /// than a tenth of the time: after a drawing that took t, the next one is not before 9 t later.
    void refresh(const FleetState& fleet, const Now& now);

    /// Shows the final table and draws the final map. On a terminal, only the first page of the
    /// table is shown. Throws Error if the map cannot be written.
    void finish(const FleetState& fleet, const Now& now);

    /// Reports a message to the user. If the table is shown on a terminal, the message appears
    /// below the table and again at the end; otherwise it is printed on standard error.
    /// Thread-safe.
    void tell(const std::string& message);

    const FleetMap& map() const { return map_; }

  private:
    using Clock = std::chrono::steady_clock;

    void leave_screen(const FleetState& fleet, const Now& now);
    void show_page(const FleetState& fleet, const Now& now);
    void draw(const FleetState& fleet, const Now& now);

    FleetMap map_;
    std::string drawing_;
    Delivery delivery_;
    FleetPage page_;
    std::optional<TerminalScreen> screen_;
    std::mutex mutex_;                  ///< guards `messages_` and the end of `screen_`
    std::deque<std::string> messages_;  ///< newest messages, printed when `screen_` is closed
    bool is_failing_ = false;           ///< true if the last map could not be written
    Clock::time_point next_map_;
};

}  // namespace dotpose::cli
