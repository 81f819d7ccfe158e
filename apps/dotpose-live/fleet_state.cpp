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

void FleetState::take(std::string_view topic, std::string_view payload, const Now& now) {
    const auto sender = parse_topic(topic);
    const bool is_connection = sender && sender->subject == Subject::connection;
    auto state = sender && !is_connection ? parse_state(payload) : std::nullopt;
    const auto connection = is_connection ? parse_connection(payload) : std::nullopt;
    const std::lock_guard lock(mutex_);
    if (state) {
        take_state(sender->robot, std::move(*state), now);
    } else if (connection) {
        take_connection(sender->robot, *connection, now);
    } else if (is_connection && payload.empty()) {
        remove(sender->robot);
    } else {
        ++bad_;
    }
}

void FleetState::take_connection(std::string_view name, const RobotConnection& connection,
                                 const Now& now) {
    FleetRobot& shown = touch(name).shown;
    shown.presence = connection.presence;
    // The age of the message is computed from its time stamp, because a retained message may be
    // days old when it arrives.
    const std::int64_t age_us = std::max<std::int64_t>(now.system_us - connection.sent_us, 0);
    shown.alive_us = std::max(shown.alive_us, now.watched_us - age_us);
}

void FleetState::take_state(std::string_view name, RobotState state, const Now& now) {
    Robot& robot = touch(name);
    FleetRobot& shown = robot.shown;
    count_latency(static_cast<float>(now.system_us - state.sent_us) * 1e-3F);
    const auto arrival = robot.numbers.take(state, shown.counts);
    if (arrival == StateNumbers::Arrival::repeated) return;
    const bool is_late = arrival == StateNumbers::Arrival::late;
    if (!is_late) note_sign_of_life(robot, state, now);
    // A lost robot keeps its last known position.
    if (!state.is_localized) {
        state.map_id = shown.newest.map_id;
        state.x_m = shown.newest.x_m;
        state.y_m = shown.newest.y_m;
        if (state.sheet.empty()) state.sheet = shown.newest.sheet;
    }
    listener_(name, state);
    if (is_late) return;
    if (state.camera) {
        count_frames(*state.camera, shown.camera);
        shown.camera = state.camera;
    }
    // Starts a new path, because coordinates on different maps are not comparable.
    if (state.is_localized && state.map_id != shown.newest.map_id) robot.path_mm.clear();
    if (!state.is_localized && (shown.newest.is_localized || shown.newest.sent_us == 0)) {
        shown.lost_since_us = now.watched_us;
    }
    shown.newest = std::move(state);
    shown.has_place = shown.has_place || shown.newest.is_localized;
    if (shown.newest.is_localized) extend_path(robot);
}

void FleetState::note_sign_of_life(Robot& robot, const RobotState& state, const Now& now) {
    FleetRobot& shown = robot.shown;
    const bool was_set_back = state.sent_us < shown.newest.sent_us;
    if (was_set_back) robot.clock.reset();
    robot.clock.take(now.watched_us, state.sent_us);
    const std::int64_t sent_us = state.sent_us + robot.clock.us();
    shown.alive_us = was_set_back ? sent_us : std::max(shown.alive_us, sent_us);
    shown.presence = publish::Presence::online;
}

FleetState::Robot& FleetState::touch(std::string_view name) {
    const auto known = robots_.find(name);
    if (known != robots_.end()) {
        by_age_.splice(by_age_.end(), by_age_, known->second.place);
        return known->second;
    }
    if (robots_.size() == kMaxRobots) remove(std::string(*by_age_.front()));
    const auto added = robots_.emplace(name, Robot()).first;
    added->second.shown.id = next_id_++;
    added->second.place = by_age_.insert(by_age_.end(), &added->first);
    return added->second;
}

void FleetState::remove(std::string_view name) {
    const auto known = robots_.find(name);
    if (known == robots_.end()) return;
    of_removed_ += known->second.shown.counts;
    by_age_.erase(known->second.place);
    robots_.erase(known);
}

void FleetState::extend_path(Robot& robot) const {
    constexpr double kStep_mm = 0.1;  // minimum step, so a stationary robot adds no points
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

void LatencyHistogram::add(double latency_s) {
    const double positive_s = std::max(latency_s, 0.0);
    const auto limit = std::ranges::lower_bound(kLimits_s, positive_s);
    ++counts[static_cast<std::size_t>(limit - kLimits_s.begin())];
    sum_s += positive_s;
}

/// Adds the frames between two consecutive reports from a robot to the totals. Adds nothing if
/// there is no previous report or the robot was restarted. A decrease in the number of frames, or
/// an increase by more than a million, is treated as a restart. Each report is compared only with
/// the previous report, so counting resumes after a restart.
void FleetState::count_frames(const CameraReport& report,
                              const std::optional<CameraReport>& previous) {
    constexpr std::uint64_t kMaxFrames = 1'000'000;
    if (!previous || report.frames < previous->frames ||
        report.frames - previous->frames > kMaxFrames) {
        return;
    }
    camera_totals_.frames += report.frames - previous->frames;
    for (std::size_t i = 0; i < report.refused.size(); ++i) {
        const std::uint64_t before = previous->refused[i];
        const std::uint64_t now = report.refused[i];
        if (now > before) camera_totals_.refused[i] += std::min(now - before, kMaxFrames);
    }
}

void FleetState::count_latency(float latency_ms) {
    latency_histogram_.add(static_cast<double>(latency_ms) * 1e-3);
    if (latencies_ms_.size() < kLatencies) {
        latencies_ms_.push_back(latency_ms);
    } else {
        latencies_ms_[next_latency_++ % kLatencies] = latency_ms;
    }
}

std::vector<std::pair<std::string, FleetRobot>> FleetState::robots(const Now& now) const {
    const std::lock_guard lock(mutex_);
    std::vector<std::pair<std::string, FleetRobot>> robots;
    robots.reserve(robots_.size());
    for (const auto& [name, robot] : robots_) {
        FleetRobot& shown = robots.emplace_back(name, robot.shown).second;
        shown.silence_us = std::max<std::int64_t>(now.watched_us - shown.alive_us, 0);
        shown.condition = condition_of(shown.newest, shown.presence, shown.silence_us, limits_);
        shown.reason = reason_of(shown.condition, shown.newest, shown.presence);
    }
    return robots;
}

std::vector<draw::Point> FleetState::path_mm(std::string_view robot) const {
    const std::lock_guard lock(mutex_);
    const auto known = robots_.find(robot);
    return known == robots_.end() ? std::vector<draw::Point>() : known->second.path_mm;
}

std::vector<draw::Point> FleetState::trail_mm(std::string_view robot, std::size_t points,
                                              std::size_t step) const {
    const std::lock_guard lock(mutex_);
    const auto known = robots_.find(robot);
    std::vector<draw::Point> trail;
    if (known == robots_.end()) return trail;
    const auto& path = known->second.path_mm;
    for (std::size_t i = path.size() - std::min(points, path.size()); i < path.size(); i += step)
        trail.push_back(path[i]);
    return trail;
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

LatencyHistogram FleetState::latency_histogram() const {
    const std::lock_guard lock(mutex_);
    return latency_histogram_;
}

CameraTotals FleetState::camera_totals() const {
    const std::lock_guard lock(mutex_);
    return camera_totals_;
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
