// Tests pen tip calibration on simulated frames from a pen whose tip position is known.
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../pen_frames.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/pen.hpp"

namespace dotpose {
namespace {

using test::kTip;
using ::testing::HasSubstr;

constexpr double kDegree_rad = std::numbers::pi / 180;
constexpr double kMaxTilt_rad = 40 * kDegree_rad;
constexpr double kX_mm = 3000;
constexpr double kY_mm = 2000;

/// Returns frames from a pen whose tip rests at one point. `place_of(i, pose)` may change the pose
/// for frame i before it is rendered.
template <typename PlaceOf>
std::vector<GreyImage> frames_of(int count, std::uint64_t seed, double max_tilt_rad,
                                 PlaceOf place_of) {
    std::vector<GreyImage> frames;
    Rng rng(seed, 7);
    for (int i = 0; i < count; ++i) {
        PenPose pose = test::pivoted(kX_mm, kY_mm, max_tilt_rad, rng);
        place_of(i, pose);
        frames.push_back(
            render(shot_of_pen(test::pen_shot(seed, static_cast<std::uint64_t>(i)), kTip, pose)));
    }
    return frames;
}

void stay(int, PenPose&) {}

PivotCalibration calibrate(const std::vector<GreyImage>& frames) {
    CalibrateOptions options;
    options.pattern.spacing_mm = test::kPenSpacing_mm;
    return calibrate_pivot(
        static_cast<int>(frames.size()), [&](int i) { return frames[static_cast<std::size_t>(i)]; },
        test::pen_camera(), options);
}

std::string error_of(const std::vector<GreyImage>& frames) {
    try {
        calibrate(frames);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

void expect_tip(const PivotCalibration& pivot) {
    const PenTip tip = pivot.camera.tip.value();
    const std::array errors{tip.x_mm - kTip.x_mm, tip.y_mm - kTip.y_mm, tip.z_mm - kTip.z_mm,
                            tip.rest_mm - kTip.rest_mm};
    const std::array keys{"tip_x_mm", "tip_y_mm", "tip_z_mm", "tip_rest_mm"};
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const double sigma = pivot.camera.sigma.at(keys[i]);
        EXPECT_LT(std::abs(errors[i]), 0.02) << keys[i];
        EXPECT_LT(std::abs(errors[i]), 4 * sigma) << keys[i];
        EXPECT_LT(sigma, 0.01) << keys[i];
    }
}

TEST(CalibratePivot, FindsTheTip) {
    const PivotCalibration pivot = calibrate(frames_of(30, 1, kMaxTilt_rad, stay));
    EXPECT_EQ(pivot.frames, 30);
    EXPECT_GE(pivot.used, 25);
    expect_tip(pivot);
    EXPECT_GT(pivot.max_tilt_rad, 30 * kDegree_rad);
    EXPECT_LT(pivot.residual_mm, 0.03);
    EXPECT_EQ(pivot.camera.focal_px, test::pen_camera().focal_px);
}

TEST(CalibratePivot, HasTrueDeviationsThoughAllFramesShowTheSamePrint) {
    // If the covariance treated the frames as independent, the mean of the squared normalised
    // errors would be 3.3 instead of 1.
    constexpr int kPens = 10;
    double squares = 0;
    for (std::uint64_t pen = 0; pen < kPens; ++pen) {
        Rng rng(pen, 9);
        std::vector<GreyImage> frames;
        for (std::uint64_t i = 0; i < 15; ++i) {
            Shot shot = test::pen_shot(40 + pen, i);
            shot.page.seed = 40 + pen;
            frames.push_back(
                render(shot_of_pen(shot, kTip, test::pivoted(kX_mm, kY_mm, kMaxTilt_rad, rng))));
        }
        const Camera camera = calibrate(frames).camera;
        squares += std::pow((camera.tip->x_mm - kTip.x_mm) / camera.sigma.at("tip_x_mm"), 2) +
                   std::pow((camera.tip->y_mm - kTip.y_mm) / camera.sigma.at("tip_y_mm"), 2);
    }
    // The mean of 20 squared standard normal variables has a standard deviation of 0.32. The
    // tolerance is three standard deviations.
    EXPECT_NEAR(squares / (2 * kPens), 1, 0.95);
}

TEST(CalibratePivot, RejectsFramesWithTheTipElsewhere) {
    const auto frames = frames_of(30, 2, kMaxTilt_rad, [](int i, PenPose& pose) {
        if (i % 8 == 0) pose.x_mm += 0.5;
        if (i % 8 == 1) pose.height_mm = 0.4;
    });
    const PivotCalibration pivot = calibrate(frames);
    EXPECT_LE(pivot.used, 30 - 8);
    expect_tip(pivot);
}

TEST(CalibratePivot, RefusesATipThatMoved) {
    const auto halves = [](int i, PenPose& pose) { pose.x_mm += i < 14 ? 0 : 1; };
    EXPECT_THAT(error_of(frames_of(28, 3, kMaxTilt_rad, halves)), HasSubstr("the tip moved"));
    const auto slide = [](int i, PenPose& pose) { pose.y_mm += 0.1 * i; };
    EXPECT_THAT(error_of(frames_of(28, 4, kMaxTilt_rad, slide)), HasSubstr("the tip moved"));
}

TEST(CalibratePivot, RefusesFramesThatDoNotPivot) {
    EXPECT_THAT(error_of(frames_of(8, 5, 1 * kDegree_rad, stay)),
                HasSubstr("tilt the pen by up to 40 degrees to all sides"));
    // Rotations about one axis do not determine the tip position along this axis.
    const auto one_axis = [](int i, PenPose& pose) {
        pose.tilt_rad = 4 * i * kDegree_rad;
        pose.azimuth_rad = 0;
        pose.turn_rad = 0;
    };
    EXPECT_THAT(error_of(frames_of(8, 6, kMaxTilt_rad, one_axis)), HasSubstr("about one axis"));
    EXPECT_THAT(error_of(frames_of(5, 7, kMaxTilt_rad, stay)), HasSubstr("at least 6 are needed"));
}

TEST(CalibratePivot, NeedsAFocalLength) {
    Camera camera = test::pen_camera();
    camera.focal_px.reset();
    EXPECT_THROW(calibrate_pivot(0, {}, camera, {}), BadArgument);
}

TEST(TipOf, IsTheTipOfTheSimulatedPen) {
    PenPose pose;
    pose.x_mm = kX_mm;
    pose.y_mm = kY_mm;
    pose.height_mm = 1.5;
    pose.tilt_rad = 30 * kDegree_rad;
    pose.azimuth_rad = 1;
    pose.turn_rad = 0.4;
    const GreyImage image = render(shot_of_pen(test::pen_shot(8, 0), kTip, pose));
    const Camera camera = test::pen_camera();
    DeviceOptions options;
    use_camera(camera, camera.width_px, camera.height_px, options);
    options.show_stages = true;
    Locator locator(options);
    Fix fix = locator.locate(image.view());
    ASSERT_EQ(fix.status, Status::ok);
    fix.spacing_nm = 300'000;
    const auto space = space_pose(fix, camera, image.view(), locator.trace());
    ASSERT_TRUE(space);
    const CameraLean lean = lean_of(space->camera.rotation);
    EXPECT_NEAR(lean.tilt_rad, pose.tilt_rad, 0.003);
    EXPECT_NEAR(lean.azimuth_rad, pose.azimuth_rad, 0.003);
    EXPECT_NEAR(lean.turn_rad, pose.turn_rad, 0.003);
    const TipPose tip = tip_of(*space, kTip);
    EXPECT_NEAR(tip.x_mm, kX_mm, 4 * tip.sigma_mm(0));
    EXPECT_NEAR(tip.y_mm, kY_mm, 4 * tip.sigma_mm(1));
    EXPECT_NEAR(tip.height_mm, 1.5, 4 * tip.sigma_mm(2));
    EXPECT_LT(tip.sigma_mm(2), 0.03);
    // The tip uncertainty in the camera file is added to the covariance.
    const TipPose uncertain =
        tip_of(*space, kTip, {{"tip_x_mm", 1}, {"tip_y_mm", 1}, {"tip_z_mm", 1}});
    EXPECT_NEAR(uncertain.sigma_mm(0), 1, 0.001);
    EXPECT_NEAR(uncertain.sigma_mm(2), 1, 0.001);
}

TEST(PenContact, HasHysteresis) {
    PenContact contact;
    const double sigma_mm = 0.01;
    const double between_mm = PenContact::kLift_mm + 2 * sigma_mm;
    EXPECT_TRUE(contact.take(between_mm, sigma_mm));
    EXPECT_FALSE(contact.take(PenContact::kLift_mm + 4 * sigma_mm, sigma_mm));
    EXPECT_FALSE(contact.take(between_mm, sigma_mm));
    EXPECT_TRUE(contact.take(-sigma_mm, sigma_mm));
}

}  // namespace
}  // namespace dotpose
