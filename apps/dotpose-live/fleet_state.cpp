#include "fleet_state.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

namespace dotpose::cli {
namespace {

double quantile(std::vector<float> values, double share) {
    if (values.empty()) return 0;
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return static_cast<double>(values[static_cast<std::size_t>(at)]);
}

}  // namespace

void FleetState::take(const std::string& payload, std::int64_t now_us) {
    const auto state = parse_state(payload);
    const std::lock_guard lock(mutex_);
    if (!state) {
        ++bad_;
        return;
    }
    ++messages_;
    const auto latency_ms = static_cast<float>(now_us - state->sent_us) * 1e-3F;
    if (latencies_ms_.size() < kLatencies) {
        latencies_ms_.push_back(latency_ms);
    } else {
        latencies_ms_[static_cast<std::size_t>(messages_) % kLatencies] = latency_ms;
    }
    FleetRobot& robot = robots_[state->robot];
    const bool is_first = robot.messages++ == 0;
    robot.heard_us = now_us;
    if (!is_first && state->sent_us < robot.newest.sent_us) {
        robot.missed = std::max<std::int64_t>(robot.missed - 1, 0);  // it came late
        return;
    }
    // A robot that starts anew counts from 0 again.
    if (!is_first && state->header_id > robot.newest.header_id + 1) {
        robot.missed += static_cast<std::int64_t>(state->header_id - robot.newest.header_id - 1);
    }
    robot.newest = *state;
    if (!state->is_localized) return;
    if (robot.path_mm.size() == kPath) {
        robot.path_mm.erase(robot.path_mm.begin(), robot.path_mm.begin() + kPath / 2);
    }
    robot.path_mm.push_back({state->x_m * 1000, state->y_m * 1000});
}

std::map<std::string, FleetRobot> FleetState::robots() const {
    const std::lock_guard lock(mutex_);
    return robots_;
}

std::int64_t FleetState::messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
}

std::int64_t FleetState::bad() const {
    const std::lock_guard lock(mutex_);
    return bad_;
}

Latency FleetState::latency() const {
    std::vector<float> latencies_ms;
    {
        const std::lock_guard lock(mutex_);
        latencies_ms = latencies_ms_;
    }
    return {quantile(latencies_ms, 0.5), quantile(latencies_ms, 0.99)};
}

std::string table_of(const FleetState& fleet, std::int64_t now_us) {
    std::string text =
        fmt::format("{:<16} {:<10} {:>12} {:>12} {:>9} {:>9} {:>8} {:>9} {:>7}\n", "robot", "state",
                    "x [mm]", "y [mm]", "[deg]", "[mm/s]", "age [s]", "messages", "missed");
    for (const auto& [name, robot] : fleet.robots()) {
        const RobotState& state = robot.newest;
        const auto shown = [&state](double value, int decimals) {
            return state.is_localized ? fmt::format("{:.{}f}", value, decimals) : std::string("-");
        };
        text += fmt::format("{:<16} {:<10} {:>12} {:>12} {:>9} {:>9} {:>8.1f} {:>9} {:>7}\n", name,
                            state.state, shown(state.x_m * 1000, 3), shown(state.y_m * 1000, 3),
                            shown(state.theta_rad * 180 / std::numbers::pi, 2),
                            shown(std::hypot(state.vx_m_s, state.vy_m_s) * 1000, 1),
                            static_cast<double>(now_us - robot.heard_us) * 1e-6, robot.messages,
                            robot.missed);
    }
    const Latency latency = fleet.latency();
    text += fmt::format("{} robots, {} states, {} bad, latency median {:.2f} ms, 99 % {:.2f} ms\n",
                        fleet.robots().size(), fleet.messages(), fleet.bad(), latency.median_ms,
                        latency.p99_ms);
    return text;
}

draw::Map map_of(const FleetState& fleet, const std::string& map_id,
                 std::vector<draw::MapSheet> sheets) {
    draw::Map map;
    map.title = map_id;
    map.y_up = !map_id.starts_with("pattern");
    map.sheets = std::move(sheets);
    for (const auto& [name, robot] : fleet.robots()) {
        const RobotState& state = robot.newest;
        if (robot.path_mm.empty() || (state.is_localized && state.map_id != map_id)) continue;
        draw::MapRobot drawn;
        drawn.name = name;
        drawn.strokes_mm = {robot.path_mm};
        drawn.place_mm = robot.path_mm.back();
        if (state.is_localized) drawn.heading_rad = state.theta_rad;
        drawn.is_lost = !state.is_localized;
        map.robots.push_back(std::move(drawn));
    }
    return map;
}

}  // namespace dotpose::cli
