/// Simulated frames for calibrations, with poses that a test decides.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "dotpose/camera_file.hpp"
#include "dotpose/simulate.hpp"

namespace dotpose::calibrate_test {

inline constexpr double kDegree_rad = std::numbers::pi / 180;

/// The paper's lens, III-A.3: 188 x 120 px, 12 % in the corner.
inline CameraModel paper_camera() {
    CameraModel camera;
    camera.k = -8.7e-6;
    return camera;
}

/// Frame `index` of a run, nominal, with a tilt.
inline GreyImage nominal_frame(const CameraModel& camera, std::uint64_t seed, int index,
                               double tilt_x_deg = 0, double tilt_y_deg = 0) {
    Setup setup;
    setup.camera = camera;
    setup.seed = seed;
    Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
    shot.pose.tilt_x_rad = tilt_x_deg * kDegree_rad;
    shot.pose.tilt_y_rad = tilt_y_deg * kDegree_rad;
    return render(shot);
}

/// The shot moved so that its centre looks at this place of the pattern, in section (0, 0).
inline Shot moved_to(Shot shot, double x_mm, double y_mm, double theta_rad) {
    const double x = x_mm / kDefaultSpacing_mm;
    const double y = y_mm / kDefaultSpacing_mm;
    shot.pose.cell = {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
    shot.pose.fraction_x = x - std::floor(x);
    shot.pose.fraction_y = y - std::floor(y);
    shot.pose.theta_rad = theta_rad;
    shot.page.pattern.section = {};
    return shot;
}

/// What a perfect calibration of a simulated camera that looks straight down would say.
inline Camera true_camera(const CameraModel& model) {
    Camera camera;
    camera.width_px = model.width_px;
    camera.height_px = model.height_px;
    camera.k_per_px2 = model.k;
    camera.centre_px = {(model.width_px - 1) / 2.0, (model.height_px - 1) / 2.0};
    camera.paper = PaperScale{model.mm_per_px, model.mm_per_px, 0, 0, 0};
    return camera;
}

}  // namespace dotpose::calibrate_test
