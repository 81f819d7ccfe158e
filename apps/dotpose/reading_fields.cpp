#include "reading_fields.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "dotpose/files/degrees.hpp"
#include "dotpose/tools/track_names.hpp"
#include "space_fields.hpp"

namespace dotpose::cli {
namespace {

double deviation(const TrackedPose& pose, std::size_t i) {
    return std::sqrt(static_cast<double>(pose.covariance[i][i]));
}

/// Returns the pose of a track, with the covariance of x, y and theta.
PlanePose plane_pose(const TrackedPose& pose) {
    PlanePose result{pose.x_mm(), pose.y_mm(), pose.theta_rad(), {}};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            result.covariance[i][j] = pose.covariance[i][j];
    }
    return result;
}

/// Returns the fields for the velocities and their standard deviations. With `Units::mm`, also
/// returns the standard deviations of the pose. If `is_flipped` is true, y points down in the track
/// and up in the output, so the y velocity and the turn rate are negated.
std::vector<Field> motion_fields(const TrackedPose& pose, Units units, bool is_flipped) {
    const double sign = is_flipped ? -1 : 1;
    const double vx_mm_s = static_cast<double>(pose.vx_mm_s);
    const double vy_mm_s = sign * static_cast<double>(pose.vy_mm_s);
    const double turn_rad_s = sign * static_cast<double>(pose.turn_rad_s);
    const double sigma_mm = std::max(deviation(pose, 0), deviation(pose, 1));
    const double sigma_rad = deviation(pose, 2);
    const double sigma_v_mm_s = std::max(deviation(pose, 3), deviation(pose, 4));
    const double sigma_turn_rad_s = deviation(pose, 5);
    if (units == Units::ros) {
        return {
            {"vx_m_s", decimal(vx_mm_s / 1000, 6)},
            {"vy_m_s", decimal(vy_mm_s / 1000, 6)},
            {"turn_rad_s", decimal(turn_rad_s, 6)},
            {"sigma_v_m_s", decimal(sigma_v_mm_s / 1000, 6)},
            {"sigma_turn_rad_s", decimal(sigma_turn_rad_s, 6)},
        };
    }
    return {
        {"vx_mm_s", decimal(vx_mm_s, 3)},
        {"vy_mm_s", decimal(vy_mm_s, 3)},
        {"turn_deg_s", decimal(turn_rad_s * kDegrees, 3)},
        {"track_sigma_mm", decimal(sigma_mm, 6)},
        {"track_sigma_deg", decimal(sigma_rad * kDegrees, 6)},
        {"sigma_v_mm_s", decimal(sigma_v_mm_s, 3)},
        {"sigma_turn_deg_s", decimal(sigma_turn_rad_s * kDegrees, 3)},
    };
}

/// Returns the fields for a track. The pose fields are empty while the robot is lost.
std::vector<Field> track_fields(const Track& track, Plane plane, Units units) {
    const bool is_flipped = units == Units::ros && plane == Plane::pattern;
    std::optional<PlanePose> pose;
    if (!track.is_lost) pose = plane_pose(track.pose);
    if (pose && is_flipped) pose = with_other_y(*pose);
    const auto if_tracked = [&track](std::string text) {
        return track.is_lost ? std::string() : std::move(text);
    };
    const PoseNames names = track_names(units);
    std::vector<Field> fields = {
        {"state", state_name(track), true},
        {"events", event_names(track.events), true},
        {"verdict", name(track.verdict), true},
        {"plane", if_tracked(plane == Plane::pattern ? "pattern" : "world"), true},
    };
    append(fields, pose_fields(names, units, pose));
    append(fields, covariance_fields(names, units, pose));
    for (Field& field : motion_fields(track.pose, units, is_flipped)) {
        field.text = if_tracked(std::move(field.text));
        fields.push_back(std::move(field));
    }
    return fields;
}

}  // namespace

std::vector<Field> fields(const Reading& reading, Units units) {
    std::vector<Field> all = fields(reading.record, units);
    const std::vector<Field> time = {
        {"frame", fmt::format("{}", reading.index)},
        {"t_s", decimal(static_cast<double>(reading.time_us) * 1e-6, 6)},
    };
    // Inserts the fields after the schema version, which is the first field.
    all.insert(all.begin() + 1, time.begin(), time.end());
    append(all, track_fields(reading.track, reading.plane, units));
    if (!reading.record.has_space) return all;
    append(all, space_track_fields(reading.space_track.value_or(SpaceTrack{}),
                                   reading.plane == Plane::sheet_world, reading.record.has_sheets,
                                   units));
    return all;
}

std::string csv_header_of_readings(const Record& empty, Units units) {
    Reading reading;
    reading.record = empty;
    return csv_header(fields(reading, units));
}

}  // namespace dotpose::cli
