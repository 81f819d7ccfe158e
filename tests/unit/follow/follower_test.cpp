// Tests a Follower on simulated robots. The camera is mounted beside the robot's centre. The sheets
// are known in some tests and unknown in others.
#include "dotpose/tools/follower.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "../calibrate/frames.hpp"
#include "dotpose/tools/flip.hpp"

namespace dotpose {
namespace {

using namespace calibrate_test;

constexpr std::uint64_t kSeed = 2411;
constexpr double kPivotCells_x = kPivot_x_mm / kDefaultSpacing_mm;
constexpr double kPivotCells_y = kPivot_y_mm / kDefaultSpacing_mm;

/// Returns the calibrated camera of a robot. The camera is at `kCameraOnRobot_mm` and rotated
/// relative to the robot. The reference point is the robot's centre.
Camera mounted_camera(const CameraModel& model, double theta_offset_rad) {
    Camera camera = true_camera(model);
    camera.reference_px = PixelPoint{camera.centre_px.u - kCameraOnRobot_mm.x / model.mm_per_px,
                                     camera.centre_px.v - kCameraOnRobot_mm.y / model.mm_per_px};
    camera.theta_offset_rad = theta_offset_rad;
    return camera;
}

/// Returns a sheet whose region contains the point about which the robot turns.
SheetEntry sheet_around_pivot() {
    SheetEntry entry;
    entry.name = "floor";
    entry.sheet.columns = entry.sheet.rows = 400;
    entry.sheet.origin = {static_cast<std::uint32_t>(kPivotCells_x) - 200,
                          static_cast<std::uint32_t>(kPivotCells_y) - 200};
    entry.sheet.width_mm = entry.sheet.height_mm = 400 * kDefaultSpacing_mm;
    return entry;
}

double turn_between(double a_rad, double b_rad) {
    return std::abs(std::remainder(a_rad - b_rad, 2 * std::numbers::pi));
}

TEST(Follower, TellsWhereTheRobotIsByItsCameraFile) {
    const CameraModel model;
    FollowerOptions options;
    options.code = CodeVariant::anoto;
    options.camera = mounted_camera(model, 30 * kDegree_rad);
    Follower follower(options);
    // The robot turns on the spot, so its centre does not move.
    int tracked = 0;
    constexpr int kFrames = 30;
    for (int i = 0; i < kFrames; ++i) {
        SCOPED_TRACE(testing::Message() << "frame " << i << ", seed " << kSeed);
        const double theta_rad = 0.01 * i;
        const GreyImage image = robot_frame(model, kSeed, i, kPivot_x_mm, kPivot_y_mm, theta_rad);
        const Followed now = follower.follow(image.view(), 10'000 * i);
        const Fix& fix = now.located.fix;
        ASSERT_EQ(fix.status, Status::ok);
        EXPECT_NEAR(fix.x_mm(), kPivot_x_mm, 0.03);
        EXPECT_NEAR(fix.y_mm(), kPivot_y_mm, 0.03);
        EXPECT_LT(turn_between(fix.theta_rad(), theta_rad + 30 * kDegree_rad), 0.003);
        EXPECT_NEAR(now.track.pose.x_mm(), kPivot_x_mm, 0.05);
        EXPECT_LT(turn_between(now.track.pose.theta_rad(), theta_rad + 30 * kDegree_rad), 0.01);
        tracked += fix.attempt == Attempt::tracked ? 1 : 0;
    }
    // Most frames are tracked because the predictions take the camera mount into account.
    EXPECT_GE(tracked, kFrames - 3);
    EXPECT_FALSE(follower.is_in_world());
}

TEST(Follower, SinglyAndInASequenceImagesGiveThePlaceOnTheSheet) {
    const CameraModel model;
    FollowerOptions options;
    options.sheets = {sheet_around_pivot()};
    options.sheets[0].world = WorldPose{1, 2, 0};
    Follower follower(options);
    EXPECT_TRUE(follower.is_in_world());
    for (int i = 0; i < 5; ++i) {
        SCOPED_TRACE(testing::Message() << "frame " << i << ", seed " << kSeed);
        const GreyImage image = robot_frame(model, kSeed, i, kPivot_x_mm, kPivot_y_mm, 1);
        const Located alone = follower.locate(image);
        const Located next = follower.follow(image.view(), 10'000 * i).located;
        ASSERT_TRUE(alone.place && next.place);
        EXPECT_EQ(alone.place->entry->name, "floor");
        EXPECT_TRUE(alone.code_is_given);
        EXPECT_DOUBLE_EQ(alone.spacing_mm, kDefaultSpacing_mm);
        // Expected position of the camera, relative to the first intersection of the sheet.
        const double x_mm = kPivot_x_mm + std::cos(1.0) * kCameraOnRobot_mm.x -
                            std::sin(1.0) * kCameraOnRobot_mm.y -
                            options.sheets[0].sheet.origin.x * kDefaultSpacing_mm;
        EXPECT_NEAR(alone.place->x_mm - alone.place->entry->sheet.origin_x_mm, x_mm, 0.01);
        EXPECT_NEAR(next.place->x_mm, alone.place->x_mm, 0.01);
        EXPECT_NEAR(next.place->y_mm, alone.place->y_mm, 0.01);
    }
}

TEST(Follower, TracksInTheWorldOfReplacedSheets) {
    const CameraModel model;
    FollowerOptions options;
    options.sheets = {sheet_around_pivot()};
    Follower follower(options);
    const auto follow = [&](int i) {
        const GreyImage image = robot_frame(model, kSeed, i, kPivot_x_mm, kPivot_y_mm, 1);
        return follower.follow(image.view(), 10'000 * i);
    };
    for (int i = 0; i < 5; ++i)
        follow(i);
    EXPECT_FALSE(follower.is_in_world());
    std::vector<SheetEntry> sheets = follower.sheets();
    sheets[0].world = WorldPose{1, 2, 0};
    follower.set_sheets(sheets);
    EXPECT_TRUE(follower.is_in_world());
    const Followed placed = follow(5);
    ASSERT_TRUE(placed.located.place);
    EXPECT_FALSE(placed.track.is_lost);
    EXPECT_NEAR(placed.track.pose.x_mm(), 1000 + placed.located.place->x_mm, 0.05);
    EXPECT_NEAR(placed.track.pose.y_mm(), 2000 - placed.located.place->y_mm, 0.05);
    // The sheet is given another pose in the world. The track must move with the sheet, although a
    // robot cannot drive this far between two frames.
    sheets[0].world = WorldPose{-4, 2, 0};
    follower.set_sheets(sheets);
    const Followed moved = follow(6);
    EXPECT_FALSE(moved.track.is_lost);
    EXPECT_NEAR(moved.track.pose.x_mm(), -4000 + moved.located.place->x_mm, 0.05);
    EXPECT_THROW(follower.set_sheets({}), BadArgument);
}

TEST(Follower, AReferencePointReplacesThatOfTheCameraFile) {
    const CameraModel model;
    const GreyImage image = robot_frame(model, kSeed, 0, kPivot_x_mm, kPivot_y_mm, 0.5);
    FollowerOptions options;
    options.code = CodeVariant::anoto;
    options.camera = mounted_camera(model, 0);
    options.reference_px = PixelPoint{(model.width_px - 1) / 2.0, (model.height_px - 1) / 2.0};
    const Fix fix = Follower(options).locate(image).fix;
    ASSERT_EQ(fix.status, Status::ok);
    // The `reference_px` option, here the image centre, takes precedence over the camera file. The
    // fix is therefore the position of the image centre, which is as far from the robot's centre as
    // the camera is.
    EXPECT_NEAR(std::hypot(fix.x_mm() - kPivot_x_mm, fix.y_mm() - kPivot_y_mm),
                std::hypot(kCameraOnRobot_mm.x, kCameraOnRobot_mm.y), 0.01);
}

TEST(Follower, TracksTheReferencePointOfAReplacedCamera) {
    const CameraModel model;
    FollowerOptions options;
    options.code = CodeVariant::anoto;
    Follower follower(options);
    const auto follow = [&](int i) {
        const GreyImage image =
            robot_frame(model, kSeed, i, kPivot_x_mm, kPivot_y_mm, kDegree_rad * i);
        return follower.follow(image.view(), 10'000 * i);
    };
    for (int i = 0; i < 10; ++i)
        follow(i);
    follower.set_camera(mounted_camera(model, 30 * kDegree_rad));
    for (int i = 10; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << "frame " << i << ", seed " << kSeed);
        const Followed now = follow(i);
        ASSERT_EQ(now.located.fix.status, Status::ok);
        EXPECT_FALSE(now.track.is_lost);
        EXPECT_NEAR(now.track.pose.x_mm(), kPivot_x_mm, 0.05);
        EXPECT_NEAR(now.track.pose.y_mm(), kPivot_y_mm, 0.05);
        EXPECT_LT(turn_between(now.located.fix.theta_rad(), (30 + i) * kDegree_rad), 0.003);
    }
    Camera camera = mounted_camera(model, 0);
    camera.width_px = 0;
    EXPECT_THROW(follower.set_camera(camera), BadArgument);
}

TEST(Follower, ImagesOfAnotherSizeThanTheCamerasAreRefused) {
    FollowerOptions options;
    options.camera = true_camera({});
    Follower follower(options);
    const GreyImage image{std::vector<std::uint8_t>(100 * 100, 200), 100, 100};
    EXPECT_THROW(follower.locate(image), BadArgument);
    EXPECT_THROW(follower.follow(image.view(), 0), BadArgument);
}

TEST(Follower, LargeImagesAreReduced) {
    dotpose::Setup setup;
    setup.camera.width_px = kMaxFrameSide_px + 2;
    setup.camera.height_px = 400;
    setup.camera.mm_per_px = kDefaultSpacing_mm / 24;
    setup.camera.working_distance_mm = 2000;
    const Shot shot = draw_shot(setup, 1);
    FollowerOptions options;
    options.code = CodeVariant::anoto;
    Follower follower(options);
    const Located located = follower.locate(render(shot));
    ASSERT_EQ(located.fix.status, Status::ok) << message(located.fix.status);
    EXPECT_EQ(located.reduced_by, 2);
    EXPECT_EQ(follower.image().width_px, (kMaxFrameSide_px + 2) / 2);
    EXPECT_NEAR(located.fix.spacing_px(), 24, 0.3);
    EXPECT_NEAR(located.fix.x_grid() - shot.pose.cell.x, shot.pose.fraction_x, 0.05);
}

/// Returns two fixes of the same frame. The first comes from `locate`, and the second from
/// `follow`.
std::vector<Fix> both_fixes(const FollowerOptions& options, const GreyImage& image) {
    return {Follower(options).locate(image).fix,
            Follower(options).follow(image.view(), 0).located.fix};
}

TEST(Follower, FlipsFramesIfItsOptionsOrTheCameraFileSaySo) {
    const CameraModel model;
    FollowerOptions options;
    options.code = CodeVariant::anoto;
    options.camera = mounted_camera(model, 30 * kDegree_rad);
    const GreyImage image = robot_frame(model, kSeed, 0, kPivot_x_mm, kPivot_y_mm, 0.3);
    const GreyImage mirrored = flipped(image.view());
    const std::vector<Fix> straight = both_fixes(options, image);
    for (const Fix& fix : both_fixes(options, mirrored))
        EXPECT_EQ(fix.status, Status::mirrored);
    FollowerOptions by_option = options;
    by_option.flip = true;
    FollowerOptions by_camera = options;
    by_camera.camera->flip = true;
    for (const FollowerOptions& flipping : {by_option, by_camera}) {
        const std::vector<Fix> fixes = both_fixes(flipping, mirrored);
        for (std::size_t i = 0; i < fixes.size(); ++i) {
            ASSERT_EQ(fixes[i].status, Status::ok);
            EXPECT_EQ(fixes[i].cell, straight[i].cell);
            EXPECT_EQ(fixes[i].fraction_x_q16, straight[i].fraction_x_q16);
            EXPECT_EQ(fixes[i].fraction_y_q16, straight[i].fraction_y_q16);
            EXPECT_EQ(fixes[i].theta_bam, straight[i].theta_bam);
        }
    }
}

}  // namespace
}  // namespace dotpose
