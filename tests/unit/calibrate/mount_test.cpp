// Tests the calibration of a camera mount on a robot that turns on the spot and drives straight
// ahead.
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../temporary_directory.hpp"
#include "../../xml_check.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/draw.hpp"
#include "dotpose/tools/mounted_pose.hpp"
#include "frames.hpp"

namespace dotpose {
namespace {

using namespace dotpose::calibrate_test;
using testing::HasSubstr;

PixelPoint true_reference(const CameraModel& camera) {
    return {(camera.width_px - 1) / 2.0 - kCameraOnRobot_mm.x / camera.mm_per_px,
            (camera.height_px - 1) / 2.0 - kCameraOnRobot_mm.y / camera.mm_per_px};
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
        EXPECT_NEAR(spin.offset_mm.x_mm, -kCameraOnRobot_mm.x, 0.02) << "seed " << seed;
        EXPECT_NEAR(spin.offset_mm.y_mm, -kCameraOnRobot_mm.y, 0.02) << "seed " << seed;
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
    Locator locator{DeviceOptions{}};
    for (int i = 20; i < 26; ++i) {
        const GreyImage image =
            robot_frame(model, 55, i, kPivot_x_mm, kPivot_y_mm, 55 * i * kDegree_rad);
        DeviceOptions options;
        use_camera(camera, image.width_px, image.height_px, options);
        locator.set_options(options);
        const Fix seen = locator.locate(image.view());
        const Fix fix = with_camera(seen, camera, locator.trace());
        ASSERT_EQ(fix.status, Status::ok);
        EXPECT_NEAR(fix.x_mm(), kPivot_x_mm, 0.03);
        EXPECT_NEAR(fix.y_mm(), kPivot_y_mm, 0.03);
        // The reference point is 16 mm from the camera, so most of its position error is caused by
        // the angle error. The reported variance must include this contribution.
        const auto variance = static_cast<double>(fix.covariance[0][0]);
        EXPECT_LT(std::abs(fix.x_mm() - kPivot_x_mm), 5 * kDefaultSpacing_mm * std::sqrt(variance));
    }
}

double off_mm(const RobotError& error) {
    EXPECT_EQ(error.located, kRobotStands);
    return std::hypot(error.place_mm.x, error.place_mm.y);
}

// The variance of the reference point is the sum of three variances, caused by errors in the turn,
// the image centre and the image axis. In the camera file, the standard deviations are 4 µm per
// axis for the centre and 3e-4 rad for the direction of the image axis. At a distance of 15.8 mm
// from the camera, the centre and the axis together contribute sqrt(4^2 + (15.8e3 * 3e-4)^2 / 2) =
// 5.2 µm per axis.
TEST(CalibrateSpin, AddsWhatTheLensDoesNotTell) {
    const CameraModel model = paper_camera();
    const auto frame_at = [&](int i) {
        return robot_frame(model, 51, i, kPivot_x_mm, kPivot_y_mm, 30 * i * kDegree_rad);
    };
    Camera camera = true_camera(model);
    const double of_turn_mm = calibrate_spin(12, frame_at, camera, {}).sigma_mm;
    camera.sigma = {{"image_centre_mm", 0.004}, {"image_axis_rad", 3e-4}};
    const double away_mm = std::hypot(kCameraOnRobot_mm.x, kCameraOnRobot_mm.y);
    EXPECT_NEAR(calibrate_spin(12, frame_at, camera, {}).sigma_mm,
                std::hypot(of_turn_mm, 0.004, 3e-4 * away_mm / std::sqrt(2)), 1e-5);
}

// The reference point is outside the image, where an estimated lens is less accurate than inside.
// However, the reference and all fixes use the same lens, so the lens error has no effect on
// positions on the paper.
TEST(CalibrateSpin, IsExactWithAnEstimatedLens) {
    const CameraModel model = paper_camera();
    for (const std::uint64_t seed : {61, 62, 63}) {
        const auto lens_frame = [&](int i) { return nominal_frame(model, seed, i); };
        const Camera lens = calibrate_lens(20, lens_frame, {}).camera;
        const auto frame_at = [&](int i) {
            return robot_frame(model, seed + 10, i, kPivot_x_mm, kPivot_y_mm, 30 * i * kDegree_rad);
        };
        const SpinCalibration spin = calibrate_spin(12, frame_at, lens, {});
        const CameraPoint& found = spin.offset_mm;
        EXPECT_LT(std::hypot(found.x_mm + kCameraOnRobot_mm.x, found.y_mm + kCameraOnRobot_mm.y),
                  0.02)
            << "seed " << seed;
        EXPECT_LT(off_mm(robot_error(spin.camera, model, seed + 20)), 0.02) << "seed " << seed;

        // The lens is calibrated again, and the reference point is converted to the new lens.
        const auto other_frame = [&](int i) { return nominal_frame(model, seed + 30, i); };
        Camera again = calibrate_lens(20, other_frame, {}).camera;
        again.reference_px = reference_in(again, spin.camera);
        EXPECT_LT(off_mm(robot_error(again, model, seed + 20)), 0.02) << "seed " << seed;

        // The heading is defined at the image centre, so it does not depend on the reference point.
        const auto drive_frame = [&](int i) {
            return robot_frame(model, seed + 40, i, kPivot_x_mm + 5 * i, kPivot_y_mm, 0);
        };
        const Camera robot = calibrate_drive(10, drive_frame, spin.camera, {}).camera;
        EXPECT_NEAR(robot.theta_offset_rad, 0, 0.01 * kDegree_rad) << "seed " << seed;
        EXPECT_NEAR(robot_error(robot, model, seed + 20).heading_rad, 0, 0.02 * kDegree_rad)
            << "seed " << seed;
    }
}

TEST(CalibrateDrive, FindsTheHeading) {
    const CameraModel model = paper_camera();
    constexpr double kDirection_rad = 2.1;
    constexpr double kOffset_rad = -1.65;  // heading minus the angle of the image x axis
    const auto frame_at = [&](int i) {
        return robot_frame(model, 56, i, kPivot_x_mm + 5 * i * std::cos(kDirection_rad),
                           kPivot_y_mm + 5 * i * std::sin(kDirection_rad),
                           kDirection_rad - kOffset_rad);
    };
    const DriveCalibration drive = calibrate_drive(10, frame_at, true_camera(model), {});
    EXPECT_NEAR(drive.camera.theta_offset_rad, kOffset_rad, 0.02 * kDegree_rad);
    EXPECT_NEAR(drive.camera.theta_offset_rad, kOffset_rad, 4 * drive.sigma_rad);
    EXPECT_NEAR(drive.length_mm, 45, 0.01);

    Locator locator{DeviceOptions{}};
    const GreyImage image = frame_at(30);
    DeviceOptions options;
    use_camera(drive.camera, image.width_px, image.height_px, options);
    locator.set_options(options);
    const Fix seen = locator.locate(image.view());
    const Fix fix = with_camera(seen, drive.camera, locator.trace());
    EXPECT_NEAR(fix.theta_rad(), kDirection_rad, 0.1 * kDegree_rad);
}

TEST(DrawSpin, IsAPictureOfTwoPanels) {
    const CameraModel model = paper_camera();
    const auto frame_at = [&](int i) {
        return robot_frame(model, 59, i, kPivot_x_mm, kPivot_y_mm, 60 * i * kDegree_rad);
    };
    const SpinCalibration spin = calibrate_spin(6, frame_at, true_camera(model), {});
    ASSERT_EQ(spin.stations.size(), 6U);
    for (const SpinStation& station : spin.stations) {
        EXPECT_NEAR(std::hypot(station.x_mm, station.y_mm),
                    std::hypot(kCameraOnRobot_mm.x, kCameraOnRobot_mm.y), 0.02);
    }
    const test::TemporaryDirectory directory;
    const auto path = directory.path() / "spin.svg";
    draw_spin(path, spin);
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    EXPECT_EQ(test::XmlCheck(text.str()).problem(), "");
    for (const char* panel : {"camera's turn<", ">What stays put<"})
        EXPECT_THAT(text.str(), HasSubstr(panel));
    EXPECT_THROW(draw_spin("/no/such/folder/a.svg", spin), Error);
}

std::string refusal(const std::function<void()>& calibrate) {
    try {
        calibrate();
    } catch (const Error& error) {
        return error.what();
    }
    return "not refused";
}

/// Returns frames taken by a robot. From each frame to the next, the robot turns by `step_deg` and
/// moves by `drift_mm` along x.
FrameAt turning(const CameraModel& model, double step_deg, double drift_mm) {
    return [=](int i) {
        return robot_frame(model, 65, i, kPivot_x_mm + drift_mm * i, kPivot_y_mm,
                           step_deg * i * kDegree_rad);
    };
}

// A robot that turns slowly while it drives does not turn on the spot, even if its frames fit an
// arc around a distant point well.
TEST(CalibrateSpin, RefusesADrive) {
    const CameraModel model;
    EXPECT_THAT(
        refusal([&] { calibrate_spin(12, turning(model, 4, 4), {}, {}); }),
        HasSubstr("the frames do not show a turn on the spot: the centre of rotation moved by"));
    EXPECT_THAT(refusal([&] { calibrate_spin(12, turning(model, 30, 4), {}, {}); }),
                HasSubstr("do not show a turn on the spot"));
    // The robot moves by half a millimetre in total while it turns by 40 degrees. The residual is
    // small, but the estimated centre of rotation is far from the true centre.
    EXPECT_THAT(refusal([&] { calibrate_spin(12, turning(model, 3.6, 0.05), {}, {}); }),
                HasSubstr("the robot moved on while it turned"));
}

// The robot moves by 0.02 mm from frame to frame. The 12 frames cover one full turn.
TEST(CalibrateSpin, CountsADriftInItsDeviation) {
    const CameraModel model;
    const SpinCalibration still = calibrate_spin(12, turning(model, 30, 0), {}, {});
    EXPECT_EQ(still.verdict, MountVerdict::good);
    EXPECT_EQ(still.drift_mm, 0);
    const SpinCalibration drifted = calibrate_spin(12, turning(model, 30, 0.02), {}, {});
    EXPECT_EQ(drifted.verdict, MountVerdict::drifted);
    const double off_mm =
        distance_mm(drifted.camera.reference_px.value(), true_reference(model), model);
    EXPECT_GT(off_mm, 0.02);
    EXPECT_LT(off_mm, 3 * drifted.sigma_mm);
}

TEST(CalibrateDrive, RefusesWhatIsNotStraightAhead) {
    const CameraModel model;
    const auto along = [&](const std::vector<double>& x_mm, const std::vector<double>& y_mm) {
        return refusal([&] {
            calibrate_drive(static_cast<int>(x_mm.size()),
                            [&](int i) {
                                const auto k = static_cast<std::size_t>(i);
                                return robot_frame(model, 66, i, kPivot_x_mm + x_mm[k],
                                                   kPivot_y_mm + y_mm[k], 0);
                            },
                            {}, {});
        });
    };
    EXPECT_EQ(along({0, 5, 10, 15, 20}, {0, 0.1, 0, -0.1, 0}), "not refused");
    EXPECT_THAT(along({0, 5, 10, 15, 20}, {0, 2, 4, 2, 0}), HasSubstr("did not drive straight"));
    EXPECT_THAT(
        along({0, 10, 5, 15, 20}, {0, 0, 0, 0, 0}),
        HasSubstr("went back by 5.00 mm: drive straight ahead, and name the frames in order"));
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
    const auto curve = [&](int i) {
        return robot_frame(model, 57, i, kPivot_x_mm + 10 * i, kPivot_y_mm, 8 * i * kDegree_rad);
    };
    EXPECT_THAT(refusal([&] { calibrate_drive(3, curve, {}, {}); }),
                HasSubstr("the robot turned by 8 degrees from its mean direction"));
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
