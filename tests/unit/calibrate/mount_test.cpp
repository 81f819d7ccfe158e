// The place of a camera on a robot that turns on the spot and drives straight ahead.
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/calibrate.hpp"
#include "dotpose/locate.hpp"
#include "frames.hpp"

namespace dotpose {
namespace {

using namespace dotpose::calibrate_test;
using testing::HasSubstr;

constexpr double kPivot_x_mm = 60'000;
constexpr double kPivot_y_mm = 45'000;

/// The image centre lies here, from the robot's centre, along the image axes.
constexpr double kCamera_x_mm = -14.5;
constexpr double kCamera_y_mm = 6.25;

/// A robot that stands at a place, in a direction of its image x axis.
GreyImage robot_frame(const CameraModel& camera, std::uint64_t seed, int index, double x_mm,
                      double y_mm, double theta_rad) {
    Setup setup;
    setup.camera = camera;
    setup.seed = seed;
    const double c = std::cos(theta_rad);
    const double s = std::sin(theta_rad);
    return render(moved_to(draw_shot(setup, static_cast<std::uint64_t>(index)),
                           x_mm + c * kCamera_x_mm - s * kCamera_y_mm,
                           y_mm + s * kCamera_x_mm + c * kCamera_y_mm, theta_rad));
}

PixelPoint true_reference(const CameraModel& camera) {
    return {(camera.width_px - 1) / 2.0 - kCamera_x_mm / camera.mm_per_px,
            (camera.height_px - 1) / 2.0 - kCamera_y_mm / camera.mm_per_px};
}

double distance_mm(PixelPoint a, PixelPoint b, const CameraModel& camera) {
    return camera.mm_per_px * std::hypot(a.u - b.u, a.v - b.v);
}

TEST(CalibrateSpin, FindsTheCentreOfTheTurn) {
    const CameraModel model = paper_camera();
    for (const std::uint64_t seed : {51, 52, 53}) {
        const auto frame_at = [&](int i) {
            return robot_frame(model, seed, i, kPivot_x_mm, kPivot_y_mm, 30 * i * kDegree_rad);
        };
        const SpinCalibration spin = calibrate_spin(12, frame_at, true_camera(model), {});
        EXPECT_EQ(spin.located, 12);
        EXPECT_NEAR(spin.turn_rad, 330 * kDegree_rad, 0.1 * kDegree_rad);
        const double off_mm =
            distance_mm(spin.camera.reference_px.value(), true_reference(model), model);
        EXPECT_LT(off_mm, 0.02) << "seed " << seed;
        EXPECT_LT(off_mm, 5 * spin.sigma_mm) << "seed " << seed;
        EXPECT_LT(spin.residual_mm, 0.02);
    }
}

TEST(CalibrateSpin, WorksWithoutACameraFileForAStraightLens) {
    const CameraModel model;
    const auto frame_at = [&](int i) {
        return robot_frame(model, 54, i, kPivot_x_mm, kPivot_y_mm, 30 * i * kDegree_rad);
    };
    const SpinCalibration spin = calibrate_spin(12, frame_at, std::nullopt, {});
    EXPECT_LT(distance_mm(spin.camera.reference_px.value(), true_reference(model), model), 0.02);
    EXPECT_EQ(spin.camera.width_px, 188);
    EXPECT_EQ(spin.camera.k_per_px2, 0);
}

TEST(CalibrateSpin, TheReferenceStaysPutAfterwards) {
    const CameraModel model = paper_camera();
    const auto frame_at = [&](int i) {
        return robot_frame(model, 55, i, kPivot_x_mm, kPivot_y_mm, 30 * i * kDegree_rad);
    };
    const Camera camera = calibrate_spin(12, frame_at, true_camera(model), {}).camera;
    const auto workspace = std::make_unique<LargeWorkspace>();
    for (int i = 20; i < 26; ++i) {
        const GreyImage image =
            robot_frame(model, 55, i, kPivot_x_mm, kPivot_y_mm, 55 * i * kDegree_rad);
        Options options;
        use_camera(camera, image.width_px, image.height_px, options);
        const Fix fix =
            with_camera(locate(image.view(), options, *workspace), camera, options, *workspace);
        ASSERT_EQ(fix.status, Status::ok);
        EXPECT_NEAR(fix.x_mm(kDefaultSpacing_mm), kPivot_x_mm, 0.03);
        EXPECT_NEAR(fix.y_mm(kDefaultSpacing_mm), kPivot_y_mm, 0.03);
        // 16 mm from the camera, an angle is most of the error.
        const auto variance = static_cast<double>(fix.covariance[0][0]);
        EXPECT_LT(std::abs(fix.x_mm(kDefaultSpacing_mm) - kPivot_x_mm),
                  5 * kDefaultSpacing_mm * std::sqrt(variance));
    }
}

TEST(CalibrateDrive, FindsTheHeading) {
    const CameraModel model = paper_camera();
    constexpr double kDirection_rad = 2.1;
    constexpr double kOffset_rad = -1.65;  // heading less image x axis
    const auto frame_at = [&](int i) {
        return robot_frame(model, 56, i, kPivot_x_mm + 5 * i * std::cos(kDirection_rad),
                           kPivot_y_mm + 5 * i * std::sin(kDirection_rad),
                           kDirection_rad - kOffset_rad);
    };
    const DriveCalibration drive = calibrate_drive(10, frame_at, true_camera(model), {});
    EXPECT_NEAR(drive.camera.theta_offset_rad, kOffset_rad, 0.02 * kDegree_rad);
    EXPECT_NEAR(drive.camera.theta_offset_rad, kOffset_rad, 4 * drive.sigma_rad);
    EXPECT_NEAR(drive.length_mm, 45, 0.01);

    const auto workspace = std::make_unique<LargeWorkspace>();
    const GreyImage image = frame_at(30);
    Options options;
    use_camera(drive.camera, image.width_px, image.height_px, options);
    const Fix fix =
        with_camera(locate(image.view(), options, *workspace), drive.camera, options, *workspace);
    EXPECT_NEAR(fix.theta_rad(), kDirection_rad, 0.1 * kDegree_rad);
}

std::string refusal(const std::function<void()>& calibrate) {
    try {
        calibrate();
    } catch (const Error& error) {
        return error.what();
    }
    return "not refused";
}

TEST(CalibrateMount, RefusesUselessFramesWithAdvice) {
    const CameraModel model;
    const auto still = [&](int i) {
        return robot_frame(model, 57, i, kPivot_x_mm, kPivot_y_mm, i * kDegree_rad);
    };
    EXPECT_THAT(refusal([&] { calibrate_spin(5, still, {}, {}); }),
                HasSubstr("the frames cover 4 degrees of a turn: turn the robot on the spot"));
    EXPECT_THAT(refusal([&] { calibrate_spin(2, still, {}, {}); }),
                HasSubstr("only 2 of 2 frames could be located; at least 3 are needed"));
    EXPECT_THAT(refusal([&] { calibrate_drive(4, still, {}, {}); }), HasSubstr("drive straight"));
    const auto camera = true_camera(paper_camera());
    CameraModel other;
    other.width_px = 200;
    EXPECT_THAT(refusal([&] {
                    calibrate_spin(3, [&](int i) { return nominal_frame(other, 58, i); }, camera,
                                   {});
                }),
                HasSubstr("188 x 120 px, not 200 x 120 px"));
}

}  // namespace
}  // namespace dotpose
