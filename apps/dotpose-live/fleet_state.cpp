#include "fleet_state.hpp"

#include <algorithm>
#include <cmath>

namespace dotpose::cli {
namespace {

double quantile(std::vector<float>& values, double share) {
    if (values.empty()) return 0;
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return static_cast<double>(values[static_cast<std::size_t>(at)]);
}

}  // namespace

void FleetState::take(std::string_view topic, std::string_view payload, std::int64_t now_us) {
    const auto sender = parse_topic(topic);
    const bool is_connection = sender && sender->subject == Subject::connection;
    auto state = sender && !is_connection ? parse_state(payload) : std::nullopt;
    const auto connection = is_connection ? parse_connection(payload) : std::nullopt;
    const std::lock_guard lock(mutex_);
    if (state) {
        take_state(sender->robot, std::move(*state), now_us);
    } else if (connection) {
        take_connection(sender->robot, *connection, now_us);
    } else {
        ++bad_;
    }
}

void FleetState::take_connection(std::string_view name, const RobotConnection& connection,
                                 std::int64_t now_us) {
    Robot& robot = touch(name);
    // A retained message may be days old, so the time it was sent is an upper limit for `heard_us`.
    FleetRobot& shown = robot.shown;
    shown.heard_us = std::max(shown.heard_us, std::min(now_us, connection.sent_us));
    if (connection.presence == publish::Presence::online) return;
    const bool is_broken = connection.presence == publish::Presence::broken;
    shown.newest.state = is_broken ? "lost" : "offline";
    shown.newest.is_localized = false;
}

void FleetState::take_state(std::string_view name, RobotState state, std::int64_t now_us) {
    Robot& robot = touch(name);
    robot.shown.heard_us = now_us;
    count_latency(static_cast<float>(now_us - state.sent_us) * 1e-3F);
    const auto arrival = robot.numbers.take(state, robot.shown.counts);
    if (arrival == StateNumbers::Arrival::repeated) return;
    // A lost robot remains on its last map.
    if (!state.is_localized) state.map_id = robot.shown.newest.map_id;
    listener_(name, state);
    if (arrival == StateNumbers::Arrival::late) return;
    robot.shown.newest = std::move(state);
    if (robot.shown.newest.is_localized) extend_path(robot);
}

FleetState::Robot& FleetState::touch(std::string_view name) {
    const auto known = robots_.find(name);
    if (known != robots_.end()) {
        by_age_.splice(by_age_.end(), by_age_, known->second.place);
        return known->second;
    }
    if (robots_.size() == kMaxRobots) remove_oldest();
    const auto added = robots_.emplace(name, Robot()).first;
    added->second.place = by_age_.insert(by_age_.end(), &added->first);
    return added->second;
}

void FleetState::remove_oldest() {
    const auto oldest = robots_.find(*by_age_.front());
    of_removed_ += oldest->second.shown.counts;
    by_age_.pop_front();
    robots_.erase(oldest);
}

void FleetState::extend_path(Robot& robot) const {
    constexpr double kStep_mm = 0.1;  // minimum step, so a resting robot adds no points to its path
    const std::size_t max_points = std::min(kPath, kAllPaths / robots_.size());
    const RobotState& newest = robot.shown.newest;
    const draw::Point place{newest.x_m * 1000, newest.y_m * 1000};
    auto& path = robot.path_mm;
    if (!path.empty() && std::hypot(place.x - path.back().x, place.y - path.back().y) < kStep_mm) {
        return;
    }
    if (path.size() >= max_points) {
        path.erase(path.begin(), path.end() - static_cast<std::ptrdiff_t>(max_points / 2));
        path.shrink_to_fit();
    }
    path.push_back(place);
}

void FleetState::count_latency(float latency_ms) {
    if (latencies_ms_.size() < kLatencies) {
        latencies_ms_.push_back(latency_ms);
    } else {
        latencies_ms_[next_latency_++ % kLatencies] = latency_ms;
    }
}

std::vector<std::pair<std::string, FleetRobot>> FleetState::robots() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::pair<std::string, FleetRobot>> robots;
    robots.reserve(robots_.size());
    for (const auto& [name, robot] : robots_)
        robots.emplace_back(name, robot.shown);
    return robots;
}

std::vector<draw::Point> FleetState::path_mm(std::string_view robot) const {
    const std::lock_guard lock(mutex_);
    const auto known = robots_.find(robot);
    return known == robots_.end() ? std::vector<draw::Point>() : known->second.path_mm;
}

StateCounts FleetState::counts() const {
    const std::lock_guard lock(mutex_);
    StateCounts counts = of_removed_;
    for (const auto& [name, robot] : robots_)
        counts += robot.shown.counts;
    return counts;
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
    const double median_ms = quantile(latencies_ms, 0.5);
    return {median_ms, quantile(latencies_ms, 0.99)};
}

}  // namespace dotpose::cli
