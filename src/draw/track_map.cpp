#include "draw/track_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "draw/bounds.hpp"

namespace dotpose::draw {
namespace {

constexpr double kSide = 1000;
constexpr double kTrackMargin = 40;
constexpr double kTrackHead = 60;

constexpr std::array kColours = {"#1565c0", "#c62828", "#2e7d32", "#6a1b9a",
                                 "#ef6c00", "#00838f", "#4e342e", "#ad1457"};

Bounds bounds_of(const Map& map) {
    Bounds bounds;
    for (const MapSheet& sheet : map.sheets) {
        for (const Point corner : sheet.corners_mm)
            bounds.add(corner);
    }
    for (const MapRobot& robot : map.robots) {
        bounds.add(robot.place_mm);
        for (const auto& stroke : robot.strokes_mm) {
            for (const Point point : stroke)
                bounds.add(point);
        }
    }
    if (bounds.is_empty()) bounds.add({0, 0});
    return bounds;
}

/// Returns true if a point is inside a page or on its edge.
bool contains(const MapSheet& sheet, Point point) {
    bool has_positive = false;
    bool has_negative = false;
    for (std::size_t i = 0; i < sheet.corners_mm.size(); ++i) {
        const Point from = sheet.corners_mm[i];
        const Point to = sheet.corners_mm[(i + 1) % sheet.corners_mm.size()];
        const double cross =
            (to.x - from.x) * (point.y - from.y) - (to.y - from.y) * (point.x - from.x);
        has_positive = has_positive || cross > 0;
        has_negative = has_negative || cross < 0;
    }
    return !(has_positive && has_negative);
}

bool visits(const MapRobot& robot, const MapSheet& sheet) {
    return contains(sheet, robot.place_mm) ||
           std::ranges::any_of(robot.strokes_mm, [&sheet](const std::vector<Point>& stroke) {
               return std::ranges::any_of(stroke, [&](Point p) { return contains(sheet, p); });
           });
}

constexpr double kNoteHeight = 24;

class MapSketch {
  public:
    explicit MapSketch(const Map& map)
        : map_(map),
          bounds_(bounds_of(map)),
          scale_(kSide /
                 std::max({bounds_.high.x - bounds_.low.x, bounds_.high.y - bounds_.low.y, 1.0})),
          svg_(std::max((bounds_.high.x - bounds_.low.x) * scale_, 400.0) + 2 * kTrackMargin,
               (bounds_.high.y - bounds_.low.y) * scale_ + 2 * kTrackMargin + kTrackHead +
                   kNoteHeight * static_cast<double>(map.notes.size()),
               map.title) {}

    std::string draw() && {
        svg_.text({kTrackMargin, kTrackMargin + 10}, 28, map_.title,
                  R"(font-weight="bold" fill="#17202a")");
        for (const MapSheet& sheet : map_.sheets)
            draw_sheet(sheet);
        for (std::size_t i = 0; i < map_.robots.size(); ++i)
            draw_robot(map_.robots[i], kColours[i % kColours.size()]);
        draw_notes();
        return std::move(svg_).finish();
    }

  private:
    Point at(Point p_mm) const {
        const double y = map_.y_up ? bounds_.high.y - p_mm.y : p_mm.y - bounds_.low.y;
        return {kTrackMargin + (p_mm.x - bounds_.low.x) * scale_,
                kTrackMargin + kTrackHead + y * scale_};
    }

    void draw_sheet(const MapSheet& sheet) {
        std::string points;
        for (const Point corner : sheet.corners_mm) {
            const Point p = at(corner);
            points += fmt::format("{:.2f},{:.2f} ", p.x, p.y);
        }
        svg_.add(R"(<polygon class="sheet" points="{}" fill="#f4f6f8" stroke="{}"/>)", points,
                 colour::kFrame);
        const Point middle = 0.5 * (at(sheet.corners_mm[0]) + at(sheet.corners_mm[2]));
        svg_.text(middle, 22, sheet.name, R"(text-anchor="middle" fill="#b8c0c8")");
    }

    void draw_robot(const MapRobot& robot, const char* colour) {
        for (const auto& stroke : robot.strokes_mm) {
            std::string data;
            for (const Point point : stroke) {
                const Point p = at(point);
                data += fmt::format("{}{:.2f} {:.2f}", data.empty() ? 'M' : 'L', p.x, p.y);
            }
            if (data.empty()) continue;
            svg_.add(R"(<path class="track" d="{}" fill="none" stroke="{}" stroke-width="2" )"
                     R"(stroke-linejoin="round" stroke-linecap="round"/>)",
                     data, colour);
        }
        const bool is_fine = robot.problem.empty();
        const char* shown = !is_fine ? colour::kBad : colour;
        const Point place = at(robot.place_mm);
        svg_.circle(place, 6, fmt::format(R"(class="robot" fill="{}")", shown));
        if (robot.heading_rad) {
            const double down = map_.y_up ? -1 : 1;
            const Point ahead{std::cos(*robot.heading_rad), down * std::sin(*robot.heading_rad)};
            svg_.arrow(place, place + 28.0 * ahead, 4, shown);
        }
        svg_.text(place + Point{10, -10}, 18,
                  is_fine ? robot.name : fmt::format("{} ({})", robot.name, robot.problem),
                  fmt::format(R"(fill="{}")", shown));
    }

    void draw_notes() {
        Point place{kTrackMargin,
                    2 * kTrackMargin + kTrackHead + (bounds_.high.y - bounds_.low.y) * scale_};
        for (const std::string& note : map_.notes) {
            svg_.text(place, 18, note, fmt::format(R"(fill="{}")", colour::kQuiet));
            place.y += kNoteHeight;
        }
    }

    const Map& map_;
    Bounds bounds_;
    double scale_;
    Svg svg_;
};

}  // namespace

void keep_visited_sheets(Map& map) {
    std::vector<MapSheet> visited;
    for (const MapSheet& sheet : map.sheets) {
        const auto visits_sheet = [&sheet](const MapRobot& robot) { return visits(robot, sheet); };
        if (std::ranges::any_of(map.robots, visits_sheet)) visited.push_back(sheet);
    }
    if (visited.empty() || visited.size() == map.sheets.size()) return;
    map.notes.push_back(
        fmt::format("{} of {} sheets, those visited", visited.size(), map.sheets.size()));
    map.sheets = std::move(visited);
}

std::string draw_map(const Map& map) {
    return MapSketch(map).draw();
}

}  // namespace dotpose::draw
