#include "fleet_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "dotpose/files/degrees.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

/// Returns the map and the sheet of the robot's last known position, with a question mark if the
/// map or the sheet is not in the sheet file.
std::string place_text(const FleetRobot& robot, const FleetMap& map) {
    if (!robot.has_place) return "-";
    const RobotState& state = robot.newest;
    return printable(state.map_id) + (state.sheet.empty() ? "" : "/" + printable(state.sheet)) +
           (map.has_place_of(robot) ? "" : "?");
}

/// Formats a coordinate of the newest pose. Returns "-" if the robot is lost.
std::string located(const RobotState& state, double value, int decimals) {
    return state.is_localized ? fmt::format("{:.{}f}", value, decimals) : std::string("-");
}

/// Formats the speed in mm/s. Returns "-" if the robot is lost, silent or gone.
std::string speed_text(const FleetRobot& robot, int decimals) {
    if (!is_fine(robot.condition)) return "-";
    const RobotState& state = robot.newest;
    return fmt::format("{:.{}f}", std::hypot(state.vx_m_s, state.vy_m_s) * kMm_per_m, decimals);
}

draw::MapRobot drawn_robot(const std::string& name, const FleetRobot& robot,
                           std::vector<draw::Point> path_mm) {
    const RobotState& state = robot.newest;
    draw::MapRobot drawn;
    drawn.name = printable(name);
    drawn.place_mm = {state.x_m * kMm_per_m, state.y_m * kMm_per_m};
    drawn.strokes_mm.push_back(std::move(path_mm));
    if (state.is_localized) drawn.heading_rad = state.theta_rad;
    if (!is_fine(robot.condition)) drawn.problem = name_of(robot.condition);
    return drawn;
}

std::string note_of(const std::string& name, const FleetRobot& robot, const FleetMap& map) {
    const RobotState& state = robot.newest;
    return fmt::format("{}: {} on {}, x {:.3f} m, y {:.3f} m", printable(name),
                       name_of(robot.condition), place_text(robot, map), state.x_m, state.y_m);
}

}  // namespace

bool FleetMap::has_place_of(const FleetRobot& robot) const {
    if (id.empty() || !robot.has_place) return true;
    const RobotState& state = robot.newest;
    return state.map_id == id && (state.sheet.empty() || names.contains(state.sheet));
}

std::string shown_map(const FleetMap& map, const FleetRobots& robots) {
    if (!map.id.empty()) return map.id;
    for (const auto& [name, robot] : robots) {
        if (robot.has_place) return robot.newest.map_id;
    }
    return {};
}

int attention_rank(const FleetRobot& robot, const FleetMap& map) {
    switch (robot.condition) {
        case Condition::silent:
            return 0;
        case Condition::lost:
            return 1;
        case Condition::gone:
            return 4;
        case Condition::moving:
        case Condition::still:
            break;
    }
    return map.has_place_of(robot) ? 3 : 2;
}

void sort_by_attention(FleetRobots& robots, const FleetMap& map) {
    std::ranges::stable_sort(
        robots, {}, [&map](const auto& entry) { return attention_rank(entry.second, map); });
}

std::string table_header(Layout layout) {
    if (layout == Layout::narrow) {
        return fmt::format("{:<14} {:<6} {:>6} {:>9} {:>9} {:>6}  {}", "robot", "state", "age[s]",
                           "x [mm]", "y [mm]", "[mm/s]", "reason, map/sheet");
    }
    return fmt::format("{:<16} {:<6} {:>8} {:>12} {:>12} {:>8} {:>8} {:>9} {:>7}  {}", "robot",
                       "state", "age [s]", "x [mm]", "y [mm]", "[deg]", "[mm/s]", "messages",
                       "missed", "reason, map/sheet");
}

std::string table_row(const std::string& name, const FleetRobot& robot, const FleetMap& map,
                      Layout layout, Delivery delivery) {
    const RobotState& state = robot.newest;
    const double age_s = static_cast<double>(robot.silence_us) * 1e-6;
    const std::string place =
        (robot.reason.empty() ? "" : printable(robot.reason) + ", ") + place_text(robot, map);
    if (layout == Layout::narrow) {
        return fmt::format("{:<14.14} {:<6} {:>6.0f} {:>9} {:>9} {:>6}  {}", printable(name),
                           name_of(robot.condition), age_s,
                           located(state, state.x_m * kMm_per_m, 1),
                           located(state, state.y_m * kMm_per_m, 1), speed_text(robot, 0), place);
    }
    const std::string missed =
        delivery == Delivery::all ? fmt::format("{}", robot.counts.missed) : std::string("-");
    return fmt::format(
        "{:<16.16} {:<6} {:>8.1f} {:>12} {:>12} {:>8} {:>8} {:>9} {:>7}  {}", printable(name),
        name_of(robot.condition), age_s, located(state, state.x_m * kMm_per_m, 3),
        located(state, state.y_m * kMm_per_m, 3), located(state, state.theta_rad * kDegrees, 2),
        speed_text(robot, 1), robot.counts.messages, missed, place);
}

std::string summary_of(const FleetState& fleet, const FleetRobots& robots, const FleetMap& map,
                       Delivery delivery) {
    std::array<int, kConditionCount> conditions{};
    for (const auto& [name, robot] : robots)
        ++conditions[static_cast<std::size_t>(robot.condition)];
    std::string text = fmt::format("{} robots", robots.size());
    for (int i = 0; i < kConditionCount; ++i) {
        text += fmt::format("{} {} {}", i == 0 ? ":" : ",", conditions[static_cast<std::size_t>(i)],
                            name_of(static_cast<Condition>(i)));
    }
    const auto unknown = std::ranges::count_if(
        robots, [&map](const auto& entry) { return !map.has_place_of(entry.second); });
    if (unknown > 0) text += fmt::format("; {} on maps or sheets not in {} (?)", unknown, map.id);
    const StateCounts counts = fleet.counts();
    const Latency latency = fleet.latency();
    const std::string missed = delivery == Delivery::all
                                   ? fmt::format("{} missed, {} late, ", counts.missed, counts.late)
                                   : std::string();
    return text +
           fmt::format(
               "\n{} robots, {} states, {} bad, {}{} repeated, latency median {:.2f} ms, 99 % "
               "{:.2f} ms\n",
               robots.size(), counts.messages, fleet.bad(), missed, counts.repeated,
               latency.median_ms, latency.p99_ms);
}

std::string table_of(const FleetState& fleet, const FleetMap& map, Delivery delivery,
                     const Now& now) {
    std::string table = table_header(Layout::wide) + '\n';
    const FleetRobots robots = fleet.robots(now);
    for (const auto& [name, robot] : robots)
        table += table_row(name, robot, map, Layout::wide, delivery) + '\n';
    return table + summary_of(fleet, robots, map, delivery);
}

draw::Map drawing_of(const FleetState& fleet, const std::string& map_id, const FleetMap& map,
                     const Now& now) {
    constexpr std::size_t kMaxNotes = 20;
    draw::Map drawing;
    drawing.title = printable(map_id);
    drawing.y_up = !map_id.starts_with("pattern");
    std::size_t elsewhere = 0;
    for (const auto& [name, robot] : fleet.robots(now)) {
        if (!robot.has_place) continue;
        if (robot.newest.map_id != map_id) {
            if (elsewhere++ < kMaxNotes) drawing.notes.push_back(note_of(name, robot, map));
            continue;
        }
        // Copies one path at a time and releases the lock between copies, because no messages can
        // be received while the lock is held.
        std::vector<draw::Point> path_mm = fleet.path_mm(name);
        if (!path_mm.empty()) {
            drawing.robots.push_back(drawn_robot(name, robot, std::move(path_mm)));
        }
    }
    if (elsewhere > kMaxNotes) {
        drawing.notes.push_back(fmt::format("{} more robots on other maps", elsewhere - kMaxNotes));
    }
    drawing.sheets = map.outlines;
    draw::keep_visited_sheets(drawing);
    return drawing;
}

}  // namespace dotpose::cli
