// Map: the sheets of a plane from above, and the paths of robots over them.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "draw/svg.hpp"

namespace dotpose::draw {

/// A page; its corners in order around it.
struct MapSheet {
    std::string name;
    std::array<Point, 4> corners_mm;
};

struct MapRobot {
    std::string name;
    std::vector<std::vector<Point>> strokes_mm;  ///< its path, cut where it jumped
    /// Where it was seen last.
    Point place_mm;
    std::optional<double> heading_rad;  ///< from +x towards +y of the plane; none: not known
    bool is_lost = false;
};

struct Map {
    std::string title;
    bool y_up = false;  ///< of the plane: true in the world, false on a page
    std::vector<MapSheet> sheets;
    std::vector<MapRobot> robots;
};

/// The drawing, as large as what is on it.
std::string draw_map(const Map& map);

}  // namespace dotpose::draw
