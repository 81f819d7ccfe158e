#include "robot_state.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <fmt/core.h>

#include "dotpose/tools/track_names.hpp"

namespace dotpose::cli {

namespace {

std::string lost_reason(const Record& record) {
    if (record.fix.status != Status::ok) return name(record.fix.status);
    const bool has_place = record.place && record.place->entry->world;
    return record.has_sheets && !has_place ? std::string(kNoPlace) : std::string();
}

/// Rotates the axes of a pose by half a turn about x, so that y points down instead of up, and z
/// points into the paper instead of out of it.
CameraInWorld with_y_down(const CameraInWorld& camera) {
    const auto [w, x, y, z] = camera.rotation;
    const double sign = x > 0 ? -1 : 1;  // keeps the w component positive
    CameraInWorld down{camera.x_m,
                       -camera.y_m,
                       -camera.z_m,
                       {-sign * x, sign * w, -sign * z, sign * y},
                       camera.covariance};
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) {
            if ((i % 3 == 0) != (j % 3 == 0)) down.covariance[i][j] *= -1;
        }
    }
    return down;
}

/// Returns the pose of the camera in space, with axes parallel to those of the track. Returns
/// nullopt if the pose is unknown or ambiguous.
std::optional<CameraInWorld> camera_pose_of(const Reading& reading) {
    const auto& space = reading.record.space;
    if (reading.plane == Plane::sheet_world) return certain_in_world(space, reading.record.place);
    if (!space || space->is_ambiguous()) return std::nullopt;
    return with_y_down(in_world(space->camera, space->covariance, WorldPose{}));
}

/// Returns the motion of the tracked camera, with axes parallel to those of the robot's track.
std::optional<CameraMotion> camera_track_of(const Reading& reading) {
    if (!reading.space_track) return std::nullopt;
    auto motion = motion_of(*reading.space_track);
    if (!motion || reading.plane == Plane::sheet_world) return motion;
    motion->pose = with_y_down(motion->pose);
    motion->velocity_m_s[1] *= -1;
    motion->velocity_m_s[2] *= -1;
    return motion;
}

}  // namespace

RobotState state_of(const Reading& reading, const std::string& robot,
                    const std::string& world_map) {
    const Track& track = reading.track;
    const TrackedPose& pose = track.pose;
    RobotState state;
    state.robot = robot;
    state.sent_us = system_us();
    state.state = state_name(track);
    state.map_id =
        reading.plane == Plane::sheet_world ? world_map : fmt::format("pattern-{}", pose.plane);
    if (reading.record.place) state.sheet = reading.record.place->entry->name;
    state.is_localized = !track.is_lost;
    if (track.is_lost) {
        state.reason = lost_reason(reading.record);
        return state;
    }
    state.x_m = pose.x_mm() / 1000;
    state.y_m = pose.y_mm() / 1000;
    state.theta_rad = pose.theta_rad();
    state.deviation_m =
        std::sqrt(static_cast<double>(std::max(pose.covariance[0][0], pose.covariance[1][1]))) /
        1000;
    state.vx_m_s = static_cast<double>(pose.vx_mm_s) / 1000;
    state.vy_m_s = static_cast<double>(pose.vy_mm_s) / 1000;
    state.omega_rad_s = static_cast<double>(pose.turn_rad_s);
    state.camera_pose = camera_pose_of(reading);
    state.camera_track = camera_track_of(reading);
    return state;
}

}  // namespace dotpose::cli
