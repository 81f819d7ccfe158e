#include "robot_state.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "dotpose/tools/track_names.hpp"

namespace dotpose::cli {

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
    state.is_localized = !track.is_lost;
    if (track.is_lost) return state;
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
