/// Simulated frames from the camera in a pen.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "dotpose/files/camera.hpp"
#include "dotpose/tools/random.hpp"
#include "dotpose/tools/simulate_pen.hpp"

namespace dotpose::test {

inline constexpr PenTip kTip{0.5, 5, 18, 0.1};
inline constexpr double kPenSpacing_mm = 0.3;

/// Returns a shot of a pen sheet, taken by a pen camera. The spacing is 0.3 mm, which is about 10
/// px in the image.
inline Shot pen_shot(std::uint64_t seed, std::uint64_t index) {
    Setup setup;
    setup.pattern.spacing_mm = kPenSpacing_mm;
    setup.pattern.displacement_mm = kPenSpacing_mm / 6;
    setup.pattern.dot_mm = kPenSpacing_mm / 6;
    setup.random_section = false;
    setup.camera.width_px = 320;
    setup.camera.height_px = 240;
    setup.camera.mm_per_px = 0.03;
    setup.camera.working_distance_mm = 16;
    setup.seed = seed;
    Shot shot = draw_shot(setup, index);
    // The print errors are assumed to be proportional to the size of the dots.
    shot.imperfections.jitter_mm = 0.005;
    return shot;
}

/// Returns the camera file for the camera of `pen_shot`, without the position of the tip.
inline Camera pen_camera() {
    Camera camera;
    camera.width_px = 320;
    camera.height_px = 240;
    camera.centre_px = {159.5, 119.5};
    camera.focal_px = 16 / 0.03;
    return camera;
}

/// Returns a random pose of a pen with its tip at (x_mm, y_mm). The pen is tilted by up to
/// `max_tilt_rad` in any direction.
inline PenPose pivoted(double x_mm, double y_mm, double max_tilt_rad, Rng& rng) {
    PenPose pose;
    pose.x_mm = x_mm;
    pose.y_mm = y_mm;
    pose.tilt_rad = rng.uniform(0, max_tilt_rad);
    pose.azimuth_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    pose.turn_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    return pose;
}

}  // namespace dotpose::test
