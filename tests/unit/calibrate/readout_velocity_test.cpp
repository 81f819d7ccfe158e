// Poses and velocities from single frames of a camera with a rolling shutter, given its camera
// file.
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "dotpose/locate.hpp"
#include "dotpose/tools/mounted_pose.hpp"
#include "frames.hpp"

namespace dotpose::calibrate_test {
namespace {

constexpr double kReadout_ms = 20;

/// A frame, and the motion of its scene in the image during the readout.
struct RollingFrame {
    Shot shot;
    Vec2 velocity_mm_s;  ///< of the camera, along the axes of the pattern
};

/// Draws a frame whose scene moves by a fraction of the image height, in a direction that depends
/// on the index, not towards the later rows.
RollingFrame draw_rolling(const CameraModel& camera, double motion, int index) {
    Setup setup;
    setup.camera = camera;
    setup.seed = 91;
    Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
    const double direction_rad = std::numbers::pi * (1 + index % 12 / 11.0);
    const Vec2 moved_px{motion * camera.height_px * std::cos(direction_rad),
                        motion * camera.height_px * std::sin(direction_rad)};
    shot.camera.readout_px = moved_px;
    const double c = std::cos(shot.pose.theta_rad);
    const double s = std::sin(shot.pose.theta_rad);
    const double mm_s = -camera.mm_per_px / (kReadout_ms / 1000);
    return {shot,
            {mm_s * (c * moved_px.x - s * moved_px.y), mm_s * (s * moved_px.x + c * moved_px.y)}};
}

TEST(ReadoutVelocity, IsWithinItsStandardDeviation) {
    const CameraModel model = paper_camera();
    Camera camera = true_camera(model);
    camera.readout_ms = kReadout_ms;
    Locator locator{DeviceOptions{}};
    for (const double motion : {0.1, 0.3, 0.6}) {
        constexpr int kFrames = 120;
        int located = 0;
        double squares = 0;
        for (int i = 0; i < kFrames; ++i) {
            const RollingFrame frame = draw_rolling(model, motion, i);
            const GreyImage image = render(frame.shot);
            DeviceOptions options;
            use_camera(camera, image.width_px, image.height_px, options);
            locator.set_options(options);
            const Fix seen = locator.locate(image.view());
            if (seen.status != Status::ok) continue;
            ++located;
            const Fix fix = with_camera(seen, camera, locator.trace());
            EXPECT_NEAR(fix.x_grid(), x_grid(frame.shot.pose), 0.012) << i;
            EXPECT_NEAR(fix.y_grid(), y_grid(frame.shot.pose), 0.012) << i;
            const auto velocity = readout_velocity(seen, camera, locator.trace());
            ASSERT_TRUE(velocity);
            const double off_x = velocity->x_per_s - frame.velocity_mm_s.x / kDefaultSpacing_mm;
            const double off_y = velocity->y_per_s - frame.velocity_mm_s.y / kDefaultSpacing_mm;
            squares += off_x * off_x / velocity->covariance[0][0] +
                       off_y * off_y / velocity->covariance[1][1];
            const double speed = std::hypot(frame.velocity_mm_s.x, frame.velocity_mm_s.y);
            EXPECT_LT(std::hypot(off_x, off_y) * kDefaultSpacing_mm, 0.04 * speed) << i;
        }
        EXPECT_GE(located, kFrames * 97 / 100) << motion;
        EXPECT_NEAR(squares / (2 * located), 1, 0.25) << motion;
    }
}

TEST(ReadoutVelocity, NeedsTheReadoutTimeAndAFix) {
    Camera camera = true_camera(paper_camera());
    Fix fix;
    fix.status = Status::ok;
    EXPECT_FALSE(readout_velocity(fix, camera, {}));
    camera.readout_ms = kReadout_ms;
    EXPECT_FALSE(readout_velocity(fix, camera, {}));
    EXPECT_FALSE(readout_velocity({}, camera, {}));
}

}  // namespace
}  // namespace dotpose::calibrate_test
