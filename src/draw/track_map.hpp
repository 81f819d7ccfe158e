// Draws a top-view map of the sheets in a plane and the paths of the robots.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "draw/svg.hpp"

namespace dotpose::draw {

/// A sheet, given by its name and its four corners. Each corner is adjacent to the previous one.
struct MapSheet {
    std::string name;
    std::array<Point, 4> corners_mm;
};

struct MapRobot {
    std::string name;
    /// Path of the robot. A new stroke begins wherever the position jumps.
    std::vector<std::vector<Point>> strokes_mm;
    Point place_mm;
    /// Angle from +x towards +y of the plane, or empty if unknown.
    std::optional<double> heading_rad;
    /// Problem to show after the name, such as "lost", or empty if there is none.
    std::string problem;
};

struct Map {
    std::string title;
    bool y_up = false;  ///< true if y points up (world), false if y points down (page)
    std::vector<MapSheet> sheets;
    std::vector<MapRobot> robots;
    std::vector<std::string> notes;  ///< lines of text below the drawing
};

/// Removes the sheets that contain neither a point on a path nor the position of a robot, and adds
/// a note with the number of remaining sheets and the total number of sheets. If no sheets would
/// remain, keeps all of them.
void keep_visited_sheets(Map& map);

/// Returns the drawing. It is as large as the bounding box of its contents.
std::string draw_map(const Map& map);

}  // namespace dotpose::draw
