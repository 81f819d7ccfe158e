#include "fleet_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include <nlohmann/json.hpp>

#include "dotpose/files/degrees.hpp"
#include "json_text.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

double rounded(double value, double steps_per_unit) {
    return std::round(value * steps_per_unit) / steps_per_unit;
}

/// Returns a string argument of a request, or an empty string if it is missing.
std::string text_in(const serve::Command& request, std::string_view key) {
    const auto* text = request.argument<std::string>(key);
    return text == nullptr ? std::string() : *text;
}

/// Returns a numeric argument of a request, truncated to an integer and clamped to [0, `max`].
/// Returns 0 if the argument is missing or NaN.
std::size_t count_in(const serve::Command& request, std::string_view key, std::size_t max) {
    const auto* number = request.argument<double>(key);
    if (number == nullptr || !(*number > 0)) return 0;
    return static_cast<std::size_t>(std::min(*number, static_cast<double>(max)));
}

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Returns true if `text` contains `part`, ignoring the case of ASCII letters. `part` must be in
/// lower case.
bool contains(std::string_view text, std::string_view part) {
    return std::ranges::search(text, part, {}, lower).begin() != text.end() || part.empty();
}

/// Selects and sorts the robots for the rows of a table.
class RowChoice {
  public:
    RowChoice(const serve::Command& request, const FleetMap& map)
        : map_(map),
          filter_(text_in(request, "filter")),
          show_(text_in(request, "show")),
          order_(text_in(request, "order")) {
        std::ranges::transform(filter_, filter_.begin(), lower);
    }

    std::vector<const FleetEntry*> rows_of(const FleetRobots& robots) const {
        std::vector<const FleetEntry*> rows;
        for (const FleetEntry& entry : robots) {
            if (is_shown(entry.second) && matches(entry)) rows.push_back(&entry);
        }
        if (order_ == "attention") {
            std::ranges::stable_sort(rows, {}, [this](const FleetEntry* row) {
                return attention_rank(row->second, map_);
            });
        } else if (order_ == "place") {
            std::ranges::stable_sort(rows, [](const FleetEntry* a, const FleetEntry* b) {
                const RobotState& left = a->second.newest;
                const RobotState& right = b->second.newest;
                const NaturalOrder is_before;
                return left.map_id != right.map_id ? is_before(left.map_id, right.map_id)
                                                   : is_before(left.sheet, right.sheet);
            });
        }
        return rows;
    }

  private:
    bool is_shown(const FleetRobot& robot) const {
        constexpr int kNeedsNone = 3;  // minimum rank of robots that do not need attention
        if (show_ == "attention") return attention_rank(robot, map_) < kNeedsNone;
        if (show_ == "unknown") return !map_.has_place_of(robot);
        return show_.empty() || show_ == "all" || show_ == name_of(robot.condition);
    }
    bool matches(const FleetEntry& entry) const {
        const auto& [name, robot] = entry;
        return contains(name, filter_) || contains(name_of(robot.condition), filter_) ||
               contains(robot.reason, filter_) ||
               (robot.has_place &&
                (contains(robot.newest.map_id, filter_) || contains(robot.newest.sheet, filter_)));
    }

    const FleetMap& map_;
    std::string filter_;
    std::string show_;
    std::string order_;
};

nlohmann::json row_of(const FleetEntry& entry, const FleetMap& map, Delivery delivery) {
    const auto& [name, robot] = entry;
    const RobotState& state = robot.newest;
    nlohmann::json row = {{"id", robot.id},
                          {"name", printable(name)},
                          {"state", name_of(robot.condition)},
                          {"reason", printable(robot.reason)},
                          {"age_s", rounded(static_cast<double>(robot.silence_us) * 1e-6, 10)},
                          {"messages", robot.counts.messages},
                          {"is_known", map.has_place_of(robot)}};
    if (delivery == Delivery::all) row["missed"] = robot.counts.missed;
    if (robot.has_place) {
        row["map"] = printable(state.map_id);
        row["sheet"] = printable(state.sheet);
    }
    if (state.is_localized) {
        row["x_mm"] = rounded(state.x_m * kMm_per_m, 1000);
        row["y_mm"] = rounded(state.y_m * kMm_per_m, 1000);
        row["theta_deg"] = rounded(state.theta_rad * kDegrees, 100);
    }
    if (is_fine(robot.condition)) {
        row["speed_mm_s"] = rounded(std::hypot(state.vx_m_s, state.vy_m_s) * kMm_per_m, 10);
    }
    return row;
}

nlohmann::json camera_json(const CameraReport& camera) {
    nlohmann::json refused = nlohmann::json::object();
    for (int i = 1; i < kStatusCount; ++i) {
        const auto count = camera.refused[static_cast<std::size_t>(i)];
        if (count > 0) refused[name(static_cast<Status>(i))] = count;
    }
    if (camera.refused.back() > 0) refused[name(Status::other)] = camera.refused.back();
    return {{"rate_hz", camera.rate_hz}, {"frames", camera.frames}, {"refused", refused}};
}

/// Returns the height and the tilt of a camera. The tilt is the acute angle between the optical
/// axis and the z axis. The angle between the two directions may be near 180 degrees, because the
/// optical axis points into the paper, but the z axis of a world frame points out of it.
nlohmann::json space_json(const CameraInWorld& camera) {
    const double tilt_rad = lean_of(camera.rotation).tilt_rad;
    return {{"height_mm", rounded(std::abs(camera.z_m) * kMm_per_m, 1000)},
            {"tilt_deg", rounded(std::min(tilt_rad, std::numbers::pi - tilt_rad) * kDegrees, 100)}};
}

nlohmann::json alert_json(const RobotAlert& alert) {
    nlohmann::json shown = {{"time_us", alert.sent_us},
                            {"robot", printable(alert.robot)},
                            {"state", alert.condition},
                            {"previous", alert.previous},
                            {"reason", printable(alert.reason)}};
    if (alert.map_id.empty()) return shown;
    shown["map"] = printable(alert.map_id);
    shown["sheet"] = printable(alert.sheet);
    return shown;
}

/// Returns the maps, each with the bounding box of its robots, in descending order of the number of
/// robots.
nlohmann::json maps_json(const FleetRobots& robots) {
    constexpr std::size_t kMaxMaps = 50;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    struct Bounds {
        int count = 0;
        double x_min_mm = kInfinity;
        double x_max_mm = -kInfinity;
        double y_min_mm = kInfinity;
        double y_max_mm = -kInfinity;
    };
    std::map<std::string, Bounds> bounds;
    for (const auto& [name, robot] : robots) {
        if (!robot.has_place) continue;
        Bounds& at = bounds[robot.newest.map_id];
        const double x_mm = robot.newest.x_m * kMm_per_m;
        const double y_mm = robot.newest.y_m * kMm_per_m;
        ++at.count;
        at.x_min_mm = std::min(at.x_min_mm, x_mm);
        at.x_max_mm = std::max(at.x_max_mm, x_mm);
        at.y_min_mm = std::min(at.y_min_mm, y_mm);
        at.y_max_mm = std::max(at.y_max_mm, y_mm);
    }
    std::vector<std::pair<std::string, Bounds>> sorted(bounds.begin(), bounds.end());
    std::ranges::stable_sort(sorted, std::ranges::greater(),
                             [](const auto& entry) { return entry.second.count; });
    nlohmann::json maps = nlohmann::json::array();
    for (const auto& [name, at] : sorted) {
        if (maps.size() == kMaxMaps) break;
        maps.push_back({{"name", printable(name)},
                        {"robots", at.count},
                        {"x_mm", {at.x_min_mm, at.x_max_mm}},
                        {"y_mm", {at.y_min_mm, at.y_max_mm}}});
    }
    return maps;
}

nlohmann::json store_json(const std::optional<store::QueueStatus>& store) {
    if (!store) return nullptr;
    return {{"is_away", store->is_away},
            {"waiting", store->waiting},
            {"stored", store->stored},
            {"dropped", store->dropped}};
}

}  // namespace

const FleetEntry* robot_with(const FleetRobots& robots, double id) {
    const auto found = std::ranges::find_if(robots, [id](const FleetEntry& entry) {
        return static_cast<double>(entry.second.id) == id;
    });
    return found == robots.end() ? nullptr : &*found;
}

std::string setup_value(const FleetMap& map, const ConditionLimits& limits,
                        const std::string& device, bool has_history) {
    nlohmann::json sheets = nlohmann::json::array();
    for (const draw::MapSheet& sheet : map.outlines) {
        nlohmann::json corners = nlohmann::json::array();
        for (const draw::Point& corner : sheet.corners_mm)
            corners.push_back({corner.x, corner.y});
        sheets.push_back({{"name", printable(sheet.name)}, {"corners_mm", std::move(corners)}});
    }
    return text_of({{"device", printable(device)},
                    {"has_history", has_history},
                    {"map", printable(map.id)},
                    {"sheets", std::move(sheets)},
                    {"silent_after_s", static_cast<double>(limits.silent_after_us) * 1e-6},
                    {"gone_after_s", static_cast<double>(limits.gone_after_us) * 1e-6}});
}

std::string summary_value(const FleetSnapshot& snapshot, const FleetState& fleet,
                          const FleetMap& map, const FleetServices& services, double states_per_s,
                          const std::deque<RobotAlert>& alerts) {
    std::array<int, kConditionCount> conditions{};
    for (const auto& [name, robot] : snapshot.robots)
        ++conditions[static_cast<std::size_t>(robot.condition)];
    nlohmann::json states = nlohmann::json::object();
    for (int i = 0; i < kConditionCount; ++i)
        states[std::string(name_of(static_cast<Condition>(i)))] =
            conditions[static_cast<std::size_t>(i)];
    nlohmann::json newest = nlohmann::json::array();
    for (auto alert = alerts.rbegin(); alert != alerts.rend() && newest.size() < kMaxAlerts;
         ++alert)
        newest.push_back(alert_json(*alert));
    const StateCounts counts = fleet.counts();
    const Latency latency = fleet.latency();
    nlohmann::json value = {
        {"robots", snapshot.robots.size()},
        {"states", std::move(states)},
        {"unknown", std::ranges::count_if(snapshot.robots,
                                          [&map](const FleetEntry& entry) {
                                              return !map.has_place_of(entry.second);
                                          })},
        {"states_per_s", rounded(states_per_s, 10)},
        {"messages", counts.messages},
        {"late", counts.late},
        {"repeated", counts.repeated},
        {"bad", fleet.bad()},
        {"latency_ms", {latency.median_ms, latency.p99_ms}},
        {"is_broker_connected", services.is_broker_connected.value_or(true)},
        {"store", store_json(services.store)},
        {"maps", maps_json(snapshot.robots)},
        {"alerts", std::move(newest)}};
    if (services.delivery == Delivery::all) value["missed"] = counts.missed;
    return text_of(value);
}

std::string table_value(const FleetSnapshot& snapshot, const FleetMap& map, Delivery delivery,
                        const serve::Command& request) {
    const std::vector<const FleetEntry*> chosen = RowChoice(request, map).rows_of(snapshot.robots);
    const std::size_t count = count_in(request, "rows", kMaxTableRows);
    // If the requested rows extend past the end of the table, the last `count` rows are returned.
    const std::size_t last = chosen.size() - std::min(chosen.size(), count);
    const std::size_t first = count_in(request, "first", last);
    nlohmann::json rows = nlohmann::json::array();
    for (std::size_t i = first; i < std::min(first + count, chosen.size()); ++i)
        rows.push_back(row_of(*chosen[i], map, delivery));
    return text_of({{"robots", snapshot.robots.size()},
                    {"matching", chosen.size()},
                    {"first", first},
                    {"rows", std::move(rows)}});
}

std::string robot_value(const FleetSnapshot& snapshot, const FleetState& fleet, const FleetMap& map,
                        Delivery delivery, const std::deque<RobotAlert>& alerts,
                        const serve::Command& request) {
    const auto* id = request.argument<double>("robot");
    const FleetEntry* entry = id == nullptr ? nullptr : robot_with(snapshot.robots, *id);
    if (entry == nullptr) return "null";
    const auto& [name, robot] = *entry;
    nlohmann::json value = row_of(*entry, map, delivery);
    value["late"] = robot.counts.late;
    value["repeated"] = robot.counts.repeated;
    if (robot.newest.is_localized) value["deviation_mm"] = robot.newest.deviation_m * kMm_per_m;
    if (robot.camera) value["camera"] = camera_json(*robot.camera);
    if (robot.newest.is_localized && robot.newest.camera_pose)
        value["space"] = space_json(*robot.newest.camera_pose);
    nlohmann::json path = nlohmann::json::array();
    for (const draw::Point& point : fleet.path_mm(name)) {
        path.push_back(rounded(point.x, 100));
        path.push_back(rounded(point.y, 100));
    }
    value["path_mm"] = std::move(path);
    nlohmann::json events = nlohmann::json::array();
    for (auto alert = alerts.rbegin(); alert != alerts.rend(); ++alert) {
        if (alert->robot == name) events.push_back(alert_json(*alert));
    }
    value["events"] = std::move(events);
    return text_of(value);
}

}  // namespace dotpose::cli
