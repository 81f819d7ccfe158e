/// The part of the `dotpose fleet` table that fits on the terminal.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fleet_report.hpp"

namespace dotpose::cli {

enum class Key { up, down, page_up, page_down, home, end, order, quit };

struct ScreenSize {
    int columns = 80;
    int rows = 24;
};

class FleetPage {
  public:
    /// Handles a key: scrolls or changes the sort order. Ignores Key::quit.
    void take(Key key);

    /// Returns exactly `size.rows` lines: a header, the visible robots, the summary, and the scroll
    /// position with the available keys. By default, the robots that need attention come first.
    std::vector<std::string> lines(const FleetState& fleet, FleetRobots robots, const FleetMap& map,
                                   Delivery delivery, ScreenSize size);

  private:
    bool is_by_attention_ = true;
    std::ptrdiff_t first_ = 0;  ///< index of the first visible robot
    std::ptrdiff_t rows_ = 1;   ///< maximum number of visible robots
};

}  // namespace dotpose::cli
