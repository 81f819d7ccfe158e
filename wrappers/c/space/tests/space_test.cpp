// Tests the C functions for poses in space: against true poses, against the C++ library, and
// misuse.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
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

namespace dotpose {
namespace {

constexpr double kDistance_mm = 25;
constexpr double kTilt_rad = 20 * std::numbers::pi / 180;

// Programs in other languages rely on the layout in the header.
static_assert(sizeof(dotpose_space_camera) == 80);
static_assert(offsetof(dotpose_space_camera, print_scale) == 72);
static_assert(sizeof(dotpose_space_pose) == 488);
static_assert(offsetof(dotpose_space_pose, covariance_mm_rad) == 96);
static_assert(offsetof(dotpose_space_pose, second_quaternion_xyzw) == 424);

struct Destroy {
    void operator()(dotpose_locator* locator) const { dotpose_locator_destroy(locator); }
};
using CLocator = std::unique_ptr<dotpose_locator, Destroy>;

/// A frame of a camera that leans by 20 degrees towards +x.
class SpaceInC : public testing::Test {
  protected:
    void SetUp() override {
        dotpose::Setup setup;
        setup.camera.width_px = 320;
        setup.camera.height_px = 240;
        setup.camera.working_distance_mm = kDistance_mm;
        setup.seed = 20;
        shot_ = draw_shot(setup, 0);
        shot_.pose.theta_rad = 0;
        shot_.pose.tilt_y_rad = kTilt_rad;
        focal_px_ = kDistance_mm / shot_.camera.mm_per_px;
        image_ = render(shot_);
        ASSERT_EQ(dotpose_space_camera_init(&camera_, sizeof camera_, 320, 240, focal_px_),
                  DOTPOSE_OK);
        ASSERT_EQ(dotpose_space_pose_init(&pose_, sizeof pose_), DOTPOSE_OK);
        locator_ = make_locator(true);
    }

    CLocator make_locator(bool for_space, int kind = DOTPOSE_KIND_LARGE) {
        dotpose_options options;
        dotpose_options_init(&options, sizeof options);
        options.code = DOTPOSE_CODE_ANOTO;
        if (for_space) {
            EXPECT_EQ(dotpose_space_use_camera(&camera_, &options), DOTPOSE_OK);
        }
        dotpose_locator* locator = nullptr;
        EXPECT_EQ(dotpose_locator_create(kind, &options, &locator), DOTPOSE_OK);
        return CLocator(locator);
    }

    dotpose_status locate(dotpose_locator* locator, const GreyImage& image) {
        dotpose_fix fix;
        dotpose_fix_init(&fix, sizeof fix);
        return dotpose_locate(locator, image.pixels.data(), image.width_px, image.height_px,
                              image.width_px, nullptr, &fix);
    }
    dotpose_status fit(const dotpose_locator* locator) {
        return dotpose_space_fit(locator, &camera_, image_.pixels.data(), 320, 240, 320, &pose_);
    }

    Shot shot_;
    GreyImage image_;
    double focal_px_ = 0;
    dotpose_space_camera camera_;
    dotpose_space_pose pose_;
    CLocator locator_;
};

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
    std::ofstream(frame, std::ios::binary)
        << "P5\n320 240\n255\n"
        << std::string(image_.pixels.begin(), image_.pixels.end());
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
    // A lens with a focal length of 20,000 px shows no perspective.
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
