/// Periodically displays the robots of a fleet as a table and as a map.
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

/// Reads the sheet file, or returns an empty map if `sheets` is empty. Throws Error if the file
/// cannot be read.
FleetMap read_fleet_map(const std::string& sheets);

class FleetView {
  public:
    /// `drawing` is the path of the map drawing. If it is empty, no map is drawn. Throws Error if
    /// the drawing cannot be written.
    FleetView(FleetMap map, std::string drawing, Delivery delivery);

    /// Processes the keys that were pressed since the previous call. If there are any, updates the
    /// table. Returns false if the user wants to quit.
    bool take_keys(const FleetState& fleet, const Now& now);

    /// Updates the table if standard output is a terminal. Also draws the map, but limits drawing
    /// to a tenth of the run time: if a drawing takes t seconds, the next one starts at least 9 t
    /// seconds later.
    void refresh(const FleetState& fleet, const Now& now);

    /// Displays the final table and draws the final map. On a terminal, only the first page of the
    /// table is displayed. Throws Error if the map cannot be written.
    void finish(const FleetState& fleet, const Now& now);

    /// Reports a message to the user. While the table is displayed on a terminal, the message
    /// appears below the table, and is printed again at the end. Otherwise, the message is printed
    /// on standard error. Thread-safe.
    void notify(const std::string& message);

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
    std::mutex mutex_;                  ///< protects `messages_` and the destruction of `screen_`
    std::deque<std::string> messages_;  ///< newest messages, printed after `screen_` is closed
    bool is_failing_ = false;           ///< true if the last attempt to write the map failed
    Clock::time_point next_map_;
};

}  // namespace dotpose::cli
