// Tests the C functions for poses in space: compares the poses with the true poses and with those
// of the C++ library, and checks misuse.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "../../../../tests/shell.hpp"
#include "../../../../tests/temporary_directory.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/image_file.hpp"
#include "dotpose/tools/simulate.hpp"
#include "dotpose/tools/space_pose.hpp"
#include "dotpose_space.h"
#include "space_frame.hpp"

namespace dotpose {
namespace {

// Programs in other languages rely on the struct layouts documented in the header.
static_assert(sizeof(dotpose_space_camera) == 80);
static_assert(offsetof(dotpose_space_camera, print_scale) == 72);
static_assert(sizeof(dotpose_space_pose) == 488);
static_assert(offsetof(dotpose_space_pose, covariance_mm_rad) == 96);
static_assert(offsetof(dotpose_space_pose, second_quaternion_xyzw) == 424);
static_assert(sizeof(dotpose_space_pen) == 64);
static_assert(sizeof(dotpose_space_tip) == 104);

TEST_F(SpaceInC, IsTheTruePose) {
    ASSERT_EQ(locate(locator_.get(), image_), DOTPOSE_OK);
    ASSERT_EQ(fit(locator_.get()), DOTPOSE_OK);
    const double mm = shot_.page.pattern.spacing_mm;
    EXPECT_NEAR(pose_.x_mm, x_grid(shot_.pose) * mm + kDistance_mm * std::sin(kTilt_rad), 0.05);
    EXPECT_NEAR(pose_.y_mm, y_grid(shot_.pose) * mm, 0.05);
    EXPECT_NEAR(pose_.z_mm, -kDistance_mm * std::cos(kTilt_rad), 0.05);
    // The camera is rotated about the y axis of the paper by -20 degrees.
    EXPECT_NEAR(pose_.quaternion_xyzw[1], -std::sin(kTilt_rad / 2), 0.002);
    EXPECT_NEAR(pose_.quaternion_xyzw[3], std::cos(kTilt_rad / 2), 0.001);
    EXPECT_NEAR(pose_.tilt_rad, kTilt_rad, 0.002);
    EXPECT_NEAR(pose_.azimuth_rad, 0, 0.005);
    EXPECT_NEAR(pose_.turn_rad, 0, 0.005);
    EXPECT_EQ(pose_.is_ambiguous, 0);
    EXPECT_GT(pose_.dots, 500);
}

TEST_F(SpaceInC, HasTheNumbersOfCpp) {
    ASSERT_EQ(locate(locator_.get(), image_), DOTPOSE_OK);
    ASSERT_EQ(fit(locator_.get()), DOTPOSE_OK);
    Camera camera;
    camera.width_px = 320;
    camera.height_px = 240;
    camera.centre_px = {159.5, 119.5};
    camera.focal_px = focal_px_;
    DeviceOptions options;
    use_camera(camera, 320, 240, options);
    options.show_stages = true;
    const auto memory = std::make_unique<LargeMemory>();
    Locator locator(*memory, options);
    const Fix fix = locator.locate(image_.view());
    const auto expected = space_pose(fix, camera, image_.view(), locator.trace());
    ASSERT_TRUE(expected);
    EXPECT_DOUBLE_EQ(pose_.x_mm, expected->camera.x_mm);
    EXPECT_DOUBLE_EQ(pose_.z_mm, expected->camera.z_mm);
    EXPECT_DOUBLE_EQ(pose_.quaternion_xyzw[0], expected->camera.rotation.x);
    EXPECT_DOUBLE_EQ(pose_.covariance_mm_rad[6 * 1 + 3], expected->covariance[1][3]);
    EXPECT_DOUBLE_EQ(pose_.residual_px, expected->residual_px);
    EXPECT_EQ(pose_.dots, expected->dots);
    EXPECT_EQ(pose_.has_second, expected->second ? 1 : 0);
}

TEST_F(SpaceInC, IsPrintedByACProgram) {
    const test::TemporaryDirectory folder;
    const std::string frame = (folder.path() / "frame.pgm").string();
    write_frame(frame);
    const test::ShellOutcome run = test::run_shell(
        "'" DOTPOSE_SPACE_ONE "' " + std::to_string(focal_px_) + " '" + frame + "' 2>&1");
    ASSERT_EQ(run.exit_code, 0) << run.output;
    double x_mm = 0;
    double y_mm = 0;
    double z_mm = 0;
    ASSERT_EQ(std::sscanf(run.output.c_str(), "position_mm %lf %lf %lf", &x_mm, &y_mm, &z_mm), 3);
    EXPECT_NEAR(y_mm, y_grid(shot_.pose) * shot_.page.pattern.spacing_mm, 0.05);
    EXPECT_NEAR(z_mm, -kDistance_mm * std::cos(kTilt_rad), 0.05);
}

TEST_F(SpaceInC, ReportsTheSecondPose) {
    // With a focal length of 20,000 px, the image has no visible perspective.
    dotpose::Setup setup;
    setup.camera.working_distance_mm = 20'000 * setup.camera.mm_per_px;
    setup.seed = 21;
    Shot shot = draw_shot(setup, 0);
    shot.pose.tilt_x_rad = 8 * std::numbers::pi / 180;
    const GreyImage far = render(shot);
    dotpose_space_camera_init(&camera_, sizeof camera_, far.width_px, far.height_px, 20'000);
    locator_ = make_locator(true);
    ASSERT_EQ(locate(locator_.get(), far), DOTPOSE_OK);
    ASSERT_EQ(dotpose_space_fit(locator_.get(), &camera_, far.pixels.data(), far.width_px,
                                far.height_px, far.width_px, &pose_),
              DOTPOSE_OK);
    EXPECT_EQ(pose_.is_ambiguous, 1);
    EXPECT_EQ(pose_.has_second, 1);
    EXPECT_GT(pose_.second_odds, 1e-9);
    EXPECT_LE(pose_.second_odds, 1);
    EXPECT_LT(pose_.second_position_mm[2], 0);
}

TEST_F(SpaceInC, FindsTheTipOfAPen) {
    ASSERT_EQ(locate(locator_.get(), image_), DOTPOSE_OK);
    ASSERT_EQ(fit(locator_.get()), DOTPOSE_OK);
    dotpose_space_pen pen;
    ASSERT_EQ(dotpose_space_pen_init(&pen, sizeof pen), DOTPOSE_OK);
    dotpose_space_tip tip;
    ASSERT_EQ(dotpose_space_tip_init(&tip, sizeof tip), DOTPOSE_OK);
    // The tip is at the point where the optical axis meets the paper. It therefore touches the
    // paper, and its position is the pattern point at the image centre.
    pen.z_mm = kDistance_mm;
    ASSERT_EQ(dotpose_space_tip_of(&pose_, &pen, &tip), DOTPOSE_OK);
    const double mm = shot_.page.pattern.spacing_mm;
    EXPECT_NEAR(tip.x_mm, x_grid(shot_.pose) * mm, 0.01);
    EXPECT_NEAR(tip.y_mm, y_grid(shot_.pose) * mm, 0.01);
    EXPECT_NEAR(tip.height_mm, 0, 0.03);
    EXPECT_GT(tip.covariance_mm2[8], 0);
    std::int32_t is_down = 0;
    EXPECT_EQ(dotpose_space_update_contact(&tip, &is_down), DOTPOSE_OK);
    EXPECT_EQ(is_down, 1);
    // The tip is 1 mm above the paper, and its distance from the camera is uncertain.
    pen.z_mm -= 1 / std::cos(kTilt_rad);
    pen.sigma_mm[2] = 0.1;
    ASSERT_EQ(dotpose_space_tip_of(&pose_, &pen, &tip), DOTPOSE_OK);
    EXPECT_NEAR(tip.height_mm, 1, 0.03);
    EXPECT_NEAR(std::sqrt(tip.covariance_mm2[8]), 0.1 * std::cos(kTilt_rad), 0.01);
    EXPECT_EQ(dotpose_space_update_contact(&tip, &is_down), DOTPOSE_OK);
    EXPECT_EQ(is_down, 0);
    // The height measured at rest is 1 mm, so a tip at a height of 1 mm touches the paper.
    pen.rest_mm = 1;
    ASSERT_EQ(dotpose_space_tip_of(&pose_, &pen, &tip), DOTPOSE_OK);
    EXPECT_NEAR(tip.height_mm, 0, 0.03);
}

TEST_F(SpaceInC, RefusesMisuseOfPens) {
    dotpose_space_pen pen;
    dotpose_space_tip tip;
    EXPECT_EQ(dotpose_space_pen_init(&pen, 8), DOTPOSE_BAD_SIZE);
    EXPECT_EQ(dotpose_space_tip_init(nullptr, sizeof tip), DOTPOSE_NULL_POINTER);
    dotpose_space_pen_init(&pen, sizeof pen);
    dotpose_space_tip_init(&tip, sizeof tip);
    EXPECT_EQ(dotpose_space_tip_of(&pose_, &pen, &tip), DOTPOSE_NO_FIX);  // no pose was fitted
    ASSERT_EQ(locate(locator_.get(), image_), DOTPOSE_OK);
    ASSERT_EQ(fit(locator_.get()), DOTPOSE_OK);
    EXPECT_EQ(dotpose_space_tip_of(nullptr, &pen, &tip), DOTPOSE_NULL_POINTER);
    EXPECT_EQ(dotpose_space_tip_of(&pose_, &pen, nullptr), DOTPOSE_NULL_POINTER);
    pen.x_mm = NAN;
    EXPECT_EQ(dotpose_space_tip_of(&pose_, &pen, &tip), DOTPOSE_BAD_VALUE);
    EXPECT_EQ(dotpose_space_update_contact(&tip, nullptr), DOTPOSE_NULL_POINTER);
}

TEST_F(SpaceInC, RefusesMisuse) {
    EXPECT_EQ(dotpose_space_camera_init(nullptr, sizeof camera_, 1, 1, 1), DOTPOSE_NULL_POINTER);
    EXPECT_EQ(dotpose_space_camera_init(&camera_, 8, 1, 1, 1), DOTPOSE_BAD_SIZE);
    EXPECT_EQ(dotpose_space_pose_init(&pose_, 8), DOTPOSE_BAD_SIZE);
    EXPECT_EQ(dotpose_space_use_camera(&camera_, nullptr), DOTPOSE_NULL_POINTER);
    EXPECT_EQ(fit(nullptr), DOTPOSE_NULL_POINTER);
    EXPECT_EQ(fit(locator_.get()), DOTPOSE_NO_FIX);  // no image was located
    const GreyImage blank{std::vector<std::uint8_t>(320 * 240, 200), 320, 240};
    EXPECT_NE(locate(locator_.get(), blank), DOTPOSE_OK);
    EXPECT_EQ(fit(locator_.get()), DOTPOSE_NO_FIX);

    ASSERT_EQ(locate(locator_.get(), image_), DOTPOSE_OK);
    const auto refused = [&](auto change) {
        const dotpose_space_camera before = camera_;
        change();
        const dotpose_status status = fit(locator_.get());
        camera_ = before;
        return status;
    };
    EXPECT_EQ(refused([&] { camera_.size = 8; }), DOTPOSE_BAD_SIZE);
    EXPECT_EQ(refused([&] { camera_.width_px = 640; }), DOTPOSE_BAD_VALUE);
    EXPECT_EQ(refused([&] { camera_.focal_u_px = NAN; }), DOTPOSE_BAD_VALUE);
    EXPECT_EQ(refused([&] { camera_.focal_v_px = -1; }), DOTPOSE_BAD_VALUE);
    EXPECT_EQ(refused([&] { camera_.print_scale = 0; }), DOTPOSE_BAD_VALUE);
    EXPECT_EQ(dotpose_space_fit(locator_.get(), &camera_, nullptr, 320, 240, 320, &pose_),
              DOTPOSE_NULL_POINTER);
    EXPECT_EQ(fit(locator_.get()), DOTPOSE_OK);

    const CLocator without_stages = make_locator(false);
    ASSERT_EQ(locate(without_stages.get(), image_), DOTPOSE_OK);
    EXPECT_EQ(fit(without_stages.get()), DOTPOSE_WRONG_KIND);
    EXPECT_EQ(fit(make_locator(false, DOTPOSE_KIND_DEVICE).get()), DOTPOSE_WRONG_KIND);
}

}  // namespace
}  // namespace dotpose
