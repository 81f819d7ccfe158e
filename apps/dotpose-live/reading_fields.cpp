#include "reading_fields.hpp"

#include <cmath>
#include <numbers>

#include <fmt/core.h>

namespace dotpose::cli {
namespace {

double deviation(const TrackedPose& pose, std::size_t i) {
    return std::sqrt(static_cast<double>(pose.covariance[i][i]));
}

/// Returns the fields of the tracker; those of the pose are empty while it is lost.
std::vector<Field> track_fields(const Track& track, Plane plane) {
    const TrackedPose& pose = track.pose;
    constexpr double kDegrees = 180 / std::numbers::pi;
    const auto if_tracked = [&track](std::string text) {
        return track.is_lost ? std::string() : std::move(text);
    };
    const auto number = [&if_tracked](double value, int decimals) {
        return if_tracked(decimal(value, decimals));
    };
    return {
        {"state", state_name(track), true},
        {"events", event_names(track.events), true},
        {"verdict", name(track.verdict), true},
        {"plane", if_tracked(plane == Plane::pattern ? "pattern" : "world"), true},
        {"track_x_mm", number(pose.x_mm(), 6)},
        {"track_y_mm", number(pose.y_mm(), 6)},
        {"track_theta_deg", if_tracked(degrees(pose.theta_rad()))},
        {"vx_mm_s", number(static_cast<double>(pose.vx_mm_s), 3)},
        {"vy_mm_s", number(static_cast<double>(pose.vy_mm_s), 3)},
        {"turn_deg_s", number(static_cast<double>(pose.turn_rad_s) * kDegrees, 3)},
        {"track_sigma_mm", number(std::max(deviation(pose, 0), deviation(pose, 1)), 6)},
        {"track_sigma_deg", number(deviation(pose, 2) * kDegrees, 6)},
        {"sigma_v_mm_s", number(std::max(deviation(pose, 3), deviation(pose, 4)), 3)},
        {"sigma_turn_deg_s", number(deviation(pose, 5) * kDegrees, 3)},
    };
}

}  // namespace

std::string state_name(const Track& track) {
    if (track.is_lost) return "lost";
    return track.is_stationary ? "stationary" : "moving";
}

std::string event_names(const TrackEvents& events) {
    std::string names;
    const auto add = [&names](bool happened, const char* name) {
        if (!happened) return;
        if (!names.empty()) names += ' ';
        names += name;
    };
    add(events.fix, "fix");
    add(events.lost, "lost");
    add(events.kidnapped, "kidnapped");
    add(events.stationary, "stationary");
    add(events.moving, "moving");
    return names;
}

std::vector<Field> fields(const Reading& reading) {
    std::vector<Field> all = {
        {"frame", fmt::format("{}", reading.index)},
        {"t_s", decimal(static_cast<double>(reading.time_us) * 1e-6, 6)},
    };
    for (Field& field : fields(reading.record))
        all.push_back(std::move(field));
    for (Field& field : track_fields(reading.track, reading.plane))
        all.push_back(std::move(field));
    return all;
}

std::string csv_header_of_readings(bool has_sheets) {
    Reading reading;
    reading.record.has_sheets = has_sheets;
    return csv_header(fields(reading));
}

}  // namespace dotpose::cli
