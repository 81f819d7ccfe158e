/// Frames in which all dots have almost the same sub-pixel phase. A frame is determined by its
/// dots, seed and index.
#pragma once

#include <cstdint>
#include <numbers>

#include "dotpose/tools/simulate.hpp"

namespace dotpose::test {

/// Dots without printing errors, seen by a camera that looks straight at the paper.
struct AlikeDots {
    int spacing_px = 11;
    double dot = 1.0 / 6;  ///< diameter, in spacings
    double blur_px = 0.7;
    double angle_deg = 0;  ///< at 0 and 90 degrees, all dots have the same sub-pixel phase
};

inline CameraModel camera_of(const AlikeDots& dots) {
    CameraModel camera;
    if (dots.spacing_px >= 16) {
        camera.width_px = 640;
        camera.height_px = 480;
    }
    camera.mm_per_px = kDefaultSpacing_mm / dots.spacing_px;
    return camera;
}

inline Shot shot_of(const AlikeDots& dots, std::uint64_t seed, int index) {
    Setup setup;
    setup.camera = camera_of(dots);
    setup.seed = seed;
    Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
    shot.pose.theta_rad = dots.angle_deg * std::numbers::pi / 180;
    shot.pose.tilt_x_rad = shot.pose.tilt_y_rad = 0;
    shot.imperfections = {};
    shot.imperfections.noise_sigma = 3;
    shot.imperfections.blur_sigma_px = dots.blur_px;
    shot.imperfections.sub_pixels = 8;  // fine sampling, because errors of 0.001 px matter
    shot.page.pattern.dot_mm = dots.dot * kDefaultSpacing_mm;
    return shot;
}

}  // namespace dotpose::test
