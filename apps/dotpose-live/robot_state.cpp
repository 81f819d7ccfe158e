#include "robot_state.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "dotpose/tools/track_names.hpp"

namespace dotpose::cli {

namespace {

std::string lost_reason(const Record& record) {
    if (record.fix.status != Status::ok) return name(record.fix.status);
    const bool has_place = record.place && record.place->entry->world;
    return record.has_sheets && !has_place ? std::string(kNoPlace) : std::string();
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
    return state;
}

}  // namespace dotpose::cli
