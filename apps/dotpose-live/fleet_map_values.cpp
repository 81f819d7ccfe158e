#include "fleet_map_values.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <vector>

#include <nlohmann/json.hpp>

#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

void append(std::string& bytes, std::unsigned_integral auto value) {
    for (std::size_t i = 0; i < sizeof value; ++i)
        bytes += static_cast<char>(value >> (8 * i) & 0xFF);
}

void append(std::string& bytes, float value) {
    append(bytes, std::bit_cast<std::uint32_t>(value));
}

void append(std::string& bytes, const draw::Point& at, const draw::Point& origin) {
    append(bytes, static_cast<float>(at.x - origin.x));
    append(bytes, static_cast<float>(at.y - origin.y));
}

/// Returns the first part of a message: the length of the JSON text of `head` in bytes, as a 32-bit
/// number, followed by the text.
std::string message_with(const nlohmann::json& head) {
    const std::string text = head.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::string bytes;
    append(bytes, static_cast<std::uint32_t>(text.size()));
    return bytes + text;
}

double number_in(const serve::Command& request, std::string_view key, double missing) {
    const auto* number = request.argument<double>(key);
    return number == nullptr ? missing : *number;
}

draw::Point place_mm(const FleetRobot& robot) {
    return {robot.newest.x_m * kMm_per_m, robot.newest.y_m * kMm_per_m};
}

/// The part of a map that a client displays.
class Window {
  public:
    Window(const FleetRobots& robots, const FleetMap& map, const serve::Command& request)
        : x_min_(number_in(request, "x_min", -kInfinity)),
          x_max_(number_in(request, "x_max", kInfinity)),
          y_min_(number_in(request, "y_min", -kInfinity)),
          y_max_(number_in(request, "y_max", kInfinity)) {
        const auto* name = request.argument<std::string>("map");
        map_ = name != nullptr ? *name : printable(shown_map(map, robots));
        for (const FleetEntry& entry : robots) {
            if (is_inside(entry.second)) visible_.push_back(&entry);
        }
        // Positions are sent in single precision, relative to an origin in the window. The origin
        // of the pattern would be unsuitable: it may be 200 km away, and at this distance single
        // precision resolves only about a centimetre.
        const draw::Point middle{(x_min_ + x_max_) / 2, (y_min_ + y_max_) / 2};
        const bool is_finite = std::isfinite(middle.x) && std::isfinite(middle.y);
        if (is_finite) {
            origin_ = middle;
        } else if (!visible_.empty()) {
            origin_ = place_mm(visible_.front()->second);
        }
    }

    const std::vector<const FleetEntry*>& visible() const { return visible_; }
    const draw::Point& origin_mm() const { return origin_; }
    nlohmann::json head() const {
        return {{"map", map_}, {"origin_mm", {origin_.x, origin_.y}}, {"count", visible_.size()}};
    }

  private:
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();

    bool is_inside(const FleetRobot& robot) const {
        if (!robot.has_place) return false;
        const auto [x, y] = place_mm(robot);
        return x >= x_min_ && x <= x_max_ && y >= y_min_ && y <= y_max_ &&
               printable(robot.newest.map_id) == map_;
    }

    std::string map_;
    double x_min_;
    double x_max_;
    double y_min_;
    double y_max_;
    std::vector<const FleetEntry*> visible_;
    draw::Point origin_;
};

std::uint16_t heading_of(const RobotState& state) {
    constexpr double kSteps_per_rad = 1e4;
    const double wrapped = std::remainder(state.theta_rad, 2 * std::numbers::pi);
    return static_cast<std::uint16_t>(static_cast<std::int16_t>(wrapped * kSteps_per_rad));
}

}  // namespace

std::string positions_value(const FleetSnapshot& snapshot, const FleetMap& map,
                            const serve::Command& request) {
    constexpr std::size_t kMaxNames = 80;  // more names would overlap on the map
    constexpr std::uint8_t kHasHeading = 1;
    constexpr std::uint8_t kIsUnknown = 2;
    const Window window(snapshot.robots, map, request);
    nlohmann::json head = window.head();
    if (window.visible().size() <= kMaxNames) {
        nlohmann::json names = nlohmann::json::array();
        for (const FleetEntry* entry : window.visible())
            names.push_back(printable(entry->first));
        head["names"] = std::move(names);
    }
    std::string bytes = message_with(head);
    for (const FleetEntry* entry : window.visible()) {
        const FleetRobot& robot = entry->second;
        append(bytes, robot.id);
        append(bytes, place_mm(robot), window.origin_mm());
        append(bytes, heading_of(robot.newest));
        append(bytes, static_cast<std::uint8_t>(robot.condition));
        const int flags = (robot.newest.is_localized ? kHasHeading : 0) |
                          (map.has_place_of(robot) ? 0 : kIsUnknown);
        append(bytes, static_cast<std::uint8_t>(flags));
    }
    return bytes;
}

std::string trails_value(const FleetSnapshot& snapshot, const FleetState& fleet,
                         const FleetMap& map, const serve::Command& request) {
    constexpr std::size_t kPoints = 200;
    const Window window(snapshot.robots, map, request);
    const std::size_t step = 1 + window.visible().size() * kPoints / kMaxTrailPoints;
    std::string bytes = message_with(window.head());
    for (const FleetEntry* entry : window.visible()) {
        const std::vector<draw::Point> trail = fleet.trail_mm(entry->first, kPoints, step);
        append(bytes, entry->second.id);
        append(bytes, static_cast<std::uint32_t>(trail.size()));
        for (const draw::Point& point : trail)
            append(bytes, point, window.origin_mm());
    }
    return bytes;
}

}  // namespace dotpose::cli
