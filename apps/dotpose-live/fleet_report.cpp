#include "fleet_report.hpp"

#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/core.h>

#include "dotpose/files/degrees.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

void add_row(std::string& table, const std::string& name, const FleetRobot& robot,
             Delivery delivery, std::int64_t now_us) {
    const RobotState& state = robot.newest;
    const auto shown = [&state](double value, int decimals) {
        return state.is_localized ? fmt::format("{:.{}f}", value, decimals) : std::string("-");
    };
    const std::string missed =
        delivery == Delivery::all ? fmt::format("{}", robot.counts.missed) : std::string("-");
    fmt::format_to(std::back_inserter(table),
                   "{:<16.16} {:<10.10} {:>12} {:>12} {:>9} {:>9} {:>8.1f} {:>9} {:>7}\n",
                   printable(name), printable(state.state), shown(state.x_m * 1000, 3),
                   shown(state.y_m * 1000, 3), shown(state.theta_rad * kDegrees, 2),
                   shown(std::hypot(state.vx_m_s, state.vy_m_s) * 1000, 1),
                   static_cast<double>(now_us - robot.heard_us) * 1e-6, robot.counts.messages,
                   missed);
}

std::string summary_of(const FleetState& fleet, std::size_t robots, Delivery delivery) {
    const StateCounts counts = fleet.counts();
    const Latency latency = fleet.latency();
    const std::string missed = delivery == Delivery::all
                                   ? fmt::format("{} missed, {} late, ", counts.missed, counts.late)
                                   : std::string();
    return fmt::format(
        "{} robots, {} states, {} bad, {}{} repeated, latency median {:.2f} ms, 99 % {:.2f} ms\n",
        robots, counts.messages, fleet.bad(), missed, counts.repeated, latency.median_ms,
        latency.p99_ms);
}

}  // namespace

std::string table_of(const FleetState& fleet, Delivery delivery, std::int64_t now_us) {
    std::string table =
        fmt::format("{:<16} {:<10} {:>12} {:>12} {:>9} {:>9} {:>8} {:>9} {:>7}\n", "robot", "state",
                    "x [mm]", "y [mm]", "[deg]", "[mm/s]", "age [s]", "messages", "missed");
    const auto robots = fleet.robots();
    for (const auto& [name, robot] : robots)
        add_row(table, name, robot, delivery, now_us);
    return table + summary_of(fleet, robots.size(), delivery);
}

draw::Map map_of(const FleetState& fleet, const std::string& map_id,
                 std::vector<draw::MapSheet> sheets) {
    draw::Map map;
    map.title = printable(map_id);
    map.y_up = !map_id.starts_with("pattern");
    map.sheets = std::move(sheets);
    for (const auto& [name, robot] : fleet.robots()) {
        const RobotState& state = robot.newest;
        if (state.is_localized && state.map_id != map_id) continue;
        // Copies one path at a time and releases the lock between copies, so messages can be
        // received.
        std::vector<draw::Point> path_mm = fleet.path_mm(name);
        if (path_mm.empty()) continue;
        draw::MapRobot drawn;
        drawn.name = printable(name);
        drawn.place_mm =
            state.is_localized ? draw::Point{state.x_m * 1000, state.y_m * 1000} : path_mm.back();
        drawn.strokes_mm.push_back(std::move(path_mm));
        if (state.is_localized) drawn.heading_rad = state.theta_rad;
        drawn.is_lost = !state.is_localized;
        map.robots.push_back(std::move(drawn));
    }
    return map;
}

}  // namespace dotpose::cli
