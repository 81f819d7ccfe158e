// Tests poses and velocities that are computed from single frames of a rolling-shutter camera, and
// the calibration of the readout time.
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "dotpose/locate.hpp"
#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/mounted_pose.hpp"
#include "frames.hpp"

namespace dotpose::calibrate_test {
namespace {

constexpr double kReadout_ms = 20;

struct RollingFrame {
    Shot shot;
    Vec2 velocity_mm_s;  ///< velocity of the camera, along the axes of the pattern
};

/// Returns a shot whose scene moves during the readout by `motion` times the height of the image.
/// The direction depends on the index, and is never downwards in the image.
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
            const auto [fix, velocity] = with_camera_and_velocity(seen, camera, locator.trace());
            EXPECT_NEAR(fix.x_grid(), x_grid(frame.shot.pose), 0.012) << i;
            EXPECT_NEAR(fix.y_grid(), y_grid(frame.shot.pose), 0.012) << i;
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

/// Adds a rotation of the camera during the readout, about the point under the image centre.
/// `velocity_mm_s` is the velocity of this point, so it does not change.
RollingFrame draw_turning(const CameraModel& camera, double motion, double turn_deg, int index) {
    RollingFrame frame = draw_rolling(camera, motion, index);
    // If theta increases, the scene turns anticlockwise in the image.
    frame.shot.camera.readout_turn_rad = -turn_deg * std::numbers::pi / 180;
    return frame;
}

TEST(ReadoutVelocity, TheTurnRateIsWithinItsStandardDeviation) {
    const CameraModel model = paper_camera();
    Camera camera = true_camera(model);
    camera.readout_ms = kReadout_ms;
    Locator locator{DeviceOptions{}};
    DeviceOptions options;
    use_camera(camera, model.width_px, model.height_px, options);
    locator.set_options(options);
    for (const double turn_deg : {0.3, 2.0, 5.0, -20.0, 45.0}) {
        constexpr int kFrames = 80;
        int located = 0;
        double squares = 0;
        double squares_of_turn = 0;
        double squares_of_place = 0;
        for (int i = 0; i < kFrames; ++i) {
            const double motion = i % 2 == 0 ? 0 : 0.1;
            const RollingFrame frame = draw_turning(model, motion, turn_deg, i);
            const Fix seen = locator.locate(render(frame.shot).view());
            if (seen.status != Status::ok) continue;
            ++located;
            const auto [fix, velocity] = with_camera_and_velocity(seen, camera, locator.trace());
            ASSERT_TRUE(velocity);
            const double off_x = velocity->x_per_s - frame.velocity_mm_s.x / kDefaultSpacing_mm;
            const double off_y = velocity->y_per_s - frame.velocity_mm_s.y / kDefaultSpacing_mm;
            const double turn_rad_s = turn_deg * std::numbers::pi / 180 / (kReadout_ms / 1000);
            const double off_turn = velocity->turn_rad_s - turn_rad_s;
            squares += off_x * off_x / velocity->covariance[0][0] +
                       off_y * off_y / velocity->covariance[1][1];
            squares_of_turn += off_turn * off_turn / velocity->covariance[2][2];
            const double place_x = fix.x_grid() - x_grid(frame.shot.pose);
            const double place_y = fix.y_grid() - y_grid(frame.shot.pose);
            EXPECT_LT(std::hypot(place_x, place_y), 0.015) << turn_deg << ", frame " << i;
            squares_of_place += place_x * place_x / double{fix.covariance[0][0]} +
                                place_y * place_y / double{fix.covariance[1][1]};
        }
        EXPECT_GE(located, kFrames * 95 / 100) << turn_deg;
        EXPECT_NEAR(squares / (2 * located), 1, 0.35) << turn_deg;
        EXPECT_NEAR(squares_of_turn / located, 1, 0.4) << turn_deg;
        EXPECT_NEAR(squares_of_place / (2 * located), 1, 0.35) << turn_deg;
    }
}

/// Returns frame `index` of a drive along a diagonal of the image, with constant acceleration. The
/// camera takes 30 frames per second and reads each frame in `readout_ms`.
GreyImage drive_frame(const CameraModel& camera, int index, double readout_ms) {
    constexpr double kInterval_s = 1 / 30.0;
    constexpr double kStart_mm_s = 20;
    constexpr double kAcceleration_mm_s2 = 100;
    constexpr double kTheta_rad = 0.7;
    const double t_s = index * kInterval_s;
    const double speed_mm_s = kStart_mm_s + kAcceleration_mm_s2 * t_s;
    const double way_mm = kStart_mm_s * t_s + kAcceleration_mm_s2 * t_s * t_s / 2;
    const Vec2 along{std::sqrt(0.5), -std::sqrt(0.5)};  // direction of motion in the image
    const double c = std::cos(kTheta_rad);
    const double s = std::sin(kTheta_rad);
    Setup setup;
    setup.camera = camera;
    setup.seed = 92;
    Shot shot = moved_to(draw_shot(setup, static_cast<std::uint64_t>(index)),
                         60'000 + way_mm * (c * along.x - s * along.y),
                         45'000 + way_mm * (s * along.x + c * along.y), kTheta_rad);
    const double moved_px = -speed_mm_s * readout_ms / 1000 / camera.mm_per_px;
    shot.camera.readout_px = {moved_px * along.x, moved_px * along.y};
    return render(shot);
}

TEST(CalibrateReadout, FindsTheReadoutTimeFromADrive) {
    const CameraModel model = paper_camera();
    for (const double readout_ms : {4.0, 20.0}) {
        const auto frame_at = [&](int i) { return drive_frame(model, i, readout_ms); };
        const ReadoutCalibration found =
            calibrate_readout(20, frame_at, true_camera(model), 1000 / 30.0, {});
        EXPECT_EQ(found.located, 20);
        EXPECT_NEAR(found.camera.readout_ms.value(), readout_ms, 4 * found.sigma_ms);
        EXPECT_LT(found.sigma_ms, 0.03 * readout_ms);
        EXPECT_EQ(found.camera.sigma.at("readout_ms"), found.sigma_ms);
    }
}

TEST(CalibrateReadout, RefusesAGlobalShutterAndTooFewFrames) {
    const CameraModel model = paper_camera();
    const auto global = [&](int i) { return drive_frame(model, i, 0); };
    const auto calibrate = [&](int frames, const Camera& camera) {
        return calibrate_readout(frames, global, camera, 1000 / 30.0, {});
    };
    EXPECT_THROW(calibrate(12, true_camera(model)), Error);
    EXPECT_THROW(calibrate(5, true_camera(model)), Error);
    Camera without_view = true_camera(model);
    without_view.paper.reset();
    EXPECT_THROW(calibrate(12, without_view), Error);
}

TEST(ReadoutVelocity, NeedsTheReadoutTimeAndAFix) {
    Camera camera = true_camera(paper_camera());
    Fix fix;
    fix.status = Status::ok;
    EXPECT_FALSE(with_camera_and_velocity(fix, camera, {}).velocity);
    camera.readout_ms = kReadout_ms;
    EXPECT_FALSE(with_camera_and_velocity(fix, camera, {}).velocity);
    EXPECT_FALSE(with_camera_and_velocity({}, camera, {}).velocity);
}

}  // namespace
}  // namespace dotpose::calibrate_test
