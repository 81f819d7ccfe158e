/// A frame taken by a tilted camera. The pose of the camera in space is known.
#pragma once

#include <numbers>

#include "dotpose/tools/simulate.hpp"

namespace dotpose::test {

/// Distance from the projection centre to the paper, along the ray through the image centre.
inline constexpr double kTiltedDistance_mm = 25;
inline constexpr double kTilt_deg = 20;
inline constexpr double kTilt_rad = kTilt_deg * std::numbers::pi / 180;

/// Returns a shot of 320 x 240 px, taken by a camera that leans by kTilt_rad towards +x.
inline Shot tilted_shot() {
    Setup setup;
    setup.camera.width_px = 320;
    setup.camera.height_px = 240;
    setup.camera.working_distance_mm = kTiltedDistance_mm;
    setup.seed = 20;
    Shot shot = draw_shot(setup, 0);
    shot.pose.theta_rad = 0;
    shot.pose.tilt_y_rad = kTilt_rad;
    return shot;
}

/// Returns the focal length of the shot's camera.
inline double focal_px_of(const Shot& shot) {
    return kTiltedDistance_mm / shot.camera.mm_per_px;
}

}  // namespace dotpose::test
