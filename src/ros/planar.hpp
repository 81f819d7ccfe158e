// Composition of poses in a plane.
#pragma once

#include <cmath>
#include <numbers>

#include "dotpose/tools/robot_messages.hpp"

namespace dotpose::ros {

/// Wraps an angle to [-pi, pi].
inline double wrapped(double angle_rad) {
    return std::remainder(angle_rad, 2 * std::numbers::pi);
}

/// Returns the pose of C in A, given the poses of B in A and of C in B.
inline PlanarPose compose(const PlanarPose& b_in_a, const PlanarPose& c_in_b) {
    const double c = std::cos(b_in_a.yaw_rad);
    const double s = std::sin(b_in_a.yaw_rad);
    return {b_in_a.x_m + c * c_in_b.x_m - s * c_in_b.y_m,
            b_in_a.y_m + s * c_in_b.x_m + c * c_in_b.y_m, wrapped(b_in_a.yaw_rad + c_in_b.yaw_rad)};
}

/// Returns the pose of A in B, given the pose of B in A.
inline PlanarPose inverse(const PlanarPose& b_in_a) {
    const double c = std::cos(b_in_a.yaw_rad);
    const double s = std::sin(b_in_a.yaw_rad);
    return {-c * b_in_a.x_m - s * b_in_a.y_m, s * b_in_a.x_m - c * b_in_a.y_m, -b_in_a.yaw_rad};
}

}  // namespace dotpose::ros
