#include "fleet_state.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

double quantile(std::vector<float> values, double share) {
    if (values.empty()) return 0;
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return static_cast<double>(values[static_cast<std::size_t>(at)]);
}

/// Whether a message is newer than the last one of its robot. It is if its number is higher,
/// whatever the sender's clock says. If number and time are both lower, the message is late, unless
/// several such messages ascend: then the robot has started again with its clock set back.
bool is_news(const RobotState& state, FleetRobot& robot) {
    constexpr int kDoubts = 5;
    const bool is_late =
        state.sent_us < robot.newest.sent_us && state.header_id <= robot.newest.header_id;
    if (!is_late) {
        robot.doubts = 0;
        return true;
    }
    // After an interruption, a queue is sent with the newest message first, so its times descend.
    robot.doubts =
        state.sent_us > robot.doubted_sent_us || robot.doubts == 0 ? robot.doubts + 1 : 1;
    robot.doubted_sent_us = state.sent_us;
    if (robot.doubts < kDoubts) return false;
    robot.doubts = 0;
    return true;
}

}  // namespace

void FleetState::take(const std::string& topic, const std::string& payload, std::int64_t now_us) {
    const auto name = robot_of(topic);
    const auto state = name ? parse_state(payload) : std::nullopt;
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
    FleetRobot& robot = heard(*name, now_us);
    const bool is_first = robot.messages++ == 0;
    if (!is_first && !is_news(*state, robot)) {
        robot.missed = std::max<std::int64_t>(robot.missed - 1, 0);
        return;
    }
    // A lower number means that the robot has started again, which is no gap.
    if (!is_first && state->header_id > robot.newest.header_id) {
        constexpr std::uint64_t kMost = 1'000'000'000;
        const std::uint64_t gap = state->header_id - robot.newest.header_id - 1;
        robot.missed += static_cast<std::int64_t>(std::min(gap, kMost));
    }
    robot.newest = *state;
    if (state->is_localized) extend_path(robot);
}

FleetRobot& FleetState::heard(const std::string& name, std::int64_t now_us) {
    const auto known = robots_.find(name);
    if (known != robots_.end()) {
        by_age_.erase({known->second.heard_us, name});
    } else if (robots_.size() == kMostRobots) {
        robots_.erase(by_age_.begin()->second);
        by_age_.erase(by_age_.begin());
    }
    by_age_.emplace(now_us, name);
    FleetRobot& robot = robots_[name];
    robot.heard_us = now_us;
    return robot;
}

void FleetState::extend_path(FleetRobot& robot) const {
    const std::size_t most = std::min(kPath, kAllPaths / robots_.size());
    auto& path = robot.path_mm;
    if (path.size() >= most) {
        path.erase(path.begin(), path.end() - static_cast<std::ptrdiff_t>(most / 2));
        path.shrink_to_fit();
    }
    path.push_back({robot.newest.x_m * 1000, robot.newest.y_m * 1000});
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
        text += fmt::format(
            "{:<16.16} {:<10.10} {:>12} {:>12} {:>9} {:>9} {:>8.1f} {:>9} {:>7}\n", printable(name),
            printable(state.state), shown(state.x_m * 1000, 3), shown(state.y_m * 1000, 3),
            shown(state.theta_rad * 180 / std::numbers::pi, 2),
            shown(std::hypot(state.vx_m_s, state.vy_m_s) * 1000, 1),
            static_cast<double>(now_us - robot.heard_us) * 1e-6, robot.messages, robot.missed);
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
    map.title = printable(map_id);
    map.y_up = !map_id.starts_with("pattern");
    map.sheets = std::move(sheets);
    for (const auto& [name, robot] : fleet.robots()) {
        const RobotState& state = robot.newest;
        if (robot.path_mm.empty() || (state.is_localized && state.map_id != map_id)) continue;
        draw::MapRobot drawn;
        drawn.name = printable(name);
        drawn.strokes_mm = {robot.path_mm};
        drawn.place_mm = robot.path_mm.back();
        if (state.is_localized) drawn.heading_rad = state.theta_rad;
        drawn.is_lost = !state.is_localized;
        map.robots.push_back(std::move(drawn));
    }
    return map;
}

}  // namespace dotpose::cli
