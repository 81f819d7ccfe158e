/// The part of the table of `dotpose fleet` that fits on a terminal.
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
    /// Scrolls, or changes the order of the robots. Ignores Key::quit.
    void take(Key key);

    /// Returns exactly `size.rows` lines: a header, the robots from the first visible one, the
    /// summary, and the position with the keys. Initially, the robots that need attention are
    /// first.
    std::vector<std::string> lines(const FleetState& fleet, FleetRobots robots, const FleetMap& map,
                                   Delivery delivery, ScreenSize size);

  private:
    bool is_by_attention_ = true;
    std::ptrdiff_t first_ = 0;  ///< index of the first visible robot
    std::ptrdiff_t rows_ = 1;   ///< number of visible robots
};

}  // namespace dotpose::cli
