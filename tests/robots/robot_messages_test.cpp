// Tests the conversion of fixes and tracks to messages. The expected frames of reference, units and
// covariances were determined by hand.
#include "dotpose/tools/robot_messages.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dotpose::test {
namespace {

using namespace ros;
using testing::HasSubstr;

constexpr double kRightAngle = std::numbers::pi / 2;

double yaw(const ros::Quaternion& rotation) {
    return 2 * std::atan2(rotation.z, rotation.w);
}

/// Returns the motion of a robot at (2 m, 1 m) with a yaw of 90 degrees. The robot drives at 0.3
/// m/s along the y axis of the world and turns.
PlanarMotion northwards() {
    PlanarMotion motion;
    motion.pose = {2, 1, kRightAngle};
    motion.vy_m_s = 0.3;
    motion.turn_rad_s = -0.5;
    for (std::size_t i = 0; i < 6; ++i)
        motion.covariance[i][i] = static_cast<double>(i + 1);
    return motion;
}

RobotUpdate update(const PlanarMotion& motion, bool is_found_again = false) {
    RobotUpdate result;
    result.time_ns = 1'500'000'000;
    result.motion = motion;
    result.state = "moving";
    result.is_found_again = is_found_again;
    return result;
}

void expect_transform(const TransformStamped& transform, double x, double y, double angle) {
    EXPECT_NEAR(transform.transform.translation.x, x, 1e-12);
    EXPECT_NEAR(transform.transform.translation.y, y, 1e-12);
    EXPECT_EQ(transform.transform.translation.z, 0);
    EXPECT_NEAR(yaw(transform.transform.rotation), angle, 1e-12);
}

TEST(RobotMessages, PutsAFixIntoTheMap) {
    RobotUpdate seen;
    seen.time_ns = 1'500'000'000;
    seen.fix = {{1, 2, kRightAngle}, PlanarCovariance{{{1, 2, 3}, {2, 4, 5}, {3, 5, 6}}}};
    const RobotMessages messages = RobotMessenger("anna").messages(seen);
    ASSERT_TRUE(messages.pose);
    EXPECT_EQ(messages.pose->header.frame_id, "map");
    EXPECT_EQ(messages.pose->header.stamp.sec, 1);
    EXPECT_EQ(messages.pose->header.stamp.nanosec, 500'000'000U);
    EXPECT_EQ(messages.pose->pose.pose.position.x, 1);
    EXPECT_EQ(messages.pose->pose.pose.position.y, 2);
    EXPECT_NEAR(yaw(messages.pose->pose.pose.orientation), kRightAngle, 1e-15);
    const double u = kUnobserved;
    const Covariance36 expected = {1, 2, 0, 0, 0, 3,  //
                                   2, 4, 0, 0, 0, 5,  //
                                   0, 0, u, 0, 0, 0,  //
                                   0, 0, 0, u, 0, 0,  //
                                   0, 0, 0, 0, u, 0,  //
                                   3, 5, 0, 0, 0, 6};
    EXPECT_EQ(messages.pose->pose.covariance, expected);
    EXPECT_FALSE(messages.odometry);
    EXPECT_FALSE(messages.tf);
}

TEST(RobotMessages, APrefixIsOfTheRobotsOwnFrames) {
    RobotFrames frames;
    frames.camera = "eye";
    const RobotMessages messages =
        RobotMessenger("anna", with_prefix("anna/", frames)).messages(update(northwards()));
    ASSERT_TRUE(messages.tf);
    EXPECT_EQ(messages.tf->transforms.at(0).header.frame_id, "map");
    EXPECT_EQ(messages.tf->transforms.at(0).child_frame_id, "anna/odom");
    EXPECT_EQ(messages.tf->transforms.at(1).child_frame_id, "anna/base_link");
    EXPECT_EQ(with_prefix("anna/", frames).camera, "anna/eye");
    EXPECT_EQ(with_prefix("").odom, "odom");
    EXPECT_THROW(with_prefix("/anna/"), BadArgument);
    EXPECT_THROW(with_prefix("anna /"), BadArgument);
}

TEST(RobotMessages, NeverSaysThatAnythingIsExact) {
    RobotUpdate seen;
    seen.fix = PlanarFix{};  // a fix without a covariance
    const RobotMessages messages = RobotMessenger("anna").messages(seen);
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_EQ(messages.pose->pose.covariance[7 * i], kUnobserved) << i;
}

TEST(RobotMessages, OdometryBeginsWhereTheRobotIsFirstSeen) {
    RobotMessenger messenger("anna");
    const PlanarMotion first = northwards();
    const RobotMessages start = messenger.messages(update(first, true));
    ASSERT_TRUE(start.tf);
    ASSERT_EQ(start.tf->transforms.size(), 2U);
    EXPECT_EQ(start.tf->transforms[0].header.frame_id, "map");
    EXPECT_EQ(start.tf->transforms[0].child_frame_id, "odom");
    EXPECT_EQ(start.tf->transforms[1].header.frame_id, "odom");
    EXPECT_EQ(start.tf->transforms[1].child_frame_id, "base_link");
    expect_transform(start.tf->transforms[0], 2, 1, kRightAngle);
    expect_transform(start.tf->transforms[1], 0, 0, 0);

    // The robot has moved 0.1 m north, which is forwards, and 0.2 m west, which is to its left.
    PlanarMotion next = first;
    next.pose = {1.8, 1.1, kRightAngle + 0.25};
    const RobotMessages then = messenger.messages(update(next));
    expect_transform(then.tf->transforms[0], 2, 1, kRightAngle);
    expect_transform(then.tf->transforms[1], 0.1, 0.2, 0.25);
    EXPECT_EQ(then.odometry->header.frame_id, "odom");
    EXPECT_EQ(then.odometry->child_frame_id, "base_link");
    EXPECT_NEAR(then.odometry->pose.pose.position.x, 0.1, 1e-12);
    EXPECT_NEAR(then.odometry->pose.pose.position.y, 0.2, 1e-12);
    // The axes of odom are those of the world rotated by 90 degrees, so the variances of x and y
    // are swapped.
    EXPECT_NEAR(then.odometry->pose.covariance[0], 2, 1e-12);
    EXPECT_NEAR(then.odometry->pose.covariance[7], 1, 1e-12);
    EXPECT_NEAR(then.odometry->pose.covariance[35], 3, 1e-12);
}

TEST(RobotMessages, OdometryGoesOnWhenTheRobotIsPutElsewhere) {
    RobotMessenger messenger("anna");
    messenger.messages(update(northwards(), true));
    PlanarMotion next = northwards();
    next.pose.y_m += 0.5;
    messenger.messages(update(next));
    // The robot is lifted, turned, and put down 10 m away.
    next.pose = {10, -3, 0};
    const RobotMessages again = messenger.messages(update(next, true));
    expect_transform(again.tf->transforms[1], 0.5, 0, 0);
    // The product of the two transforms, from map to odom and from odom to base_link, must equal
    // the pose of the robot.
    expect_transform(again.tf->transforms[0], 9.5, -3, 0);
    next.pose.x_m += 0.25;
    const RobotMessages then = messenger.messages(update(next));
    expect_transform(then.tf->transforms[0], 9.5, -3, 0);
    expect_transform(then.tf->transforms[1], 0.75, 0, 0);
}

TEST(RobotMessages, AnotherPlaneIsAnotherPlace) {
    RobotMessenger messenger("anna");
    messenger.messages(update(northwards(), true));
    RobotUpdate next = update(northwards());
    next.plane = 7;
    next.motion->pose = {500, 600, 0};
    const RobotMessages messages = messenger.messages(next);
    expect_transform(messages.tf->transforms[0], 500, 600, 0);
    expect_transform(messages.tf->transforms[1], 0, 0, 0);
}

TEST(RobotMessages, VelocitiesAreThoseOfTheRobot) {
    RobotMessenger messenger("anna");
    const RobotMessages messages = messenger.messages(update(northwards(), true));
    const TwistWithCovariance& twist = messages.odometry->twist;
    EXPECT_NEAR(twist.twist.linear.x, 0.3, 1e-12);
    EXPECT_NEAR(twist.twist.linear.y, 0, 1e-12);
    EXPECT_EQ(twist.twist.angular.z, -0.5);
    // The robot drives along the y axis of the world at 0.3 m/s. To first order, an angle error of
    // 1 rad adds 0.3 m/s to the sideways velocity, so an angle variance of 3 rad^2 adds 0.3^2 * 3
    // to the variance of the sideways velocity.
    EXPECT_NEAR(twist.covariance[0], 5, 1e-12);
    EXPECT_NEAR(twist.covariance[7], 4 + 0.3 * 0.3 * 3, 1e-12);
    EXPECT_NEAR(twist.covariance[35], 6, 1e-12);
    EXPECT_EQ(twist.covariance[14], kUnobserved);
}

TEST(RobotMessages, StatusSaysWhatIsWrong) {
    RobotMessenger messenger("anna");
    const auto state = [&messenger](const RobotUpdate& seen) {
        return messenger.messages(seen).status.status.at(0);
    };
    RobotUpdate seen = update(northwards());
    EXPECT_EQ(state(seen).level, 0);
    EXPECT_EQ(state(seen).name, "dotpose: anna");
    EXPECT_EQ(state(seen).message, "moving");
    seen.problem = "too dark";
    EXPECT_EQ(state(seen).level, 1);
    EXPECT_EQ(state(seen).message, "moving: too dark");
    seen.motion.reset();
    seen.state = "lost";
    EXPECT_EQ(state(seen).level, 2);
    EXPECT_EQ(state(seen).values.at(0).value, "lost");
}

/// Returns a track in the pattern frame, in which y points down and angles are clockwise.
Followed followed_in_pattern() {
    Followed followed;
    Fix& fix = followed.located.fix;
    fix.status = Status::ok;
    fix.cell = {1000, 2000};
    fix.theta_bam = 1 << 30;  // 90 degrees
    fix.covariance[0][0] = 4;
    fix.covariance[0][1] = fix.covariance[1][0] = 1;
    fix.covariance[1][1] = 9;
    fix.covariance[1][2] = fix.covariance[2][1] = 0.5F;
    fix.covariance[2][2] = 16;
    followed.located.spacing_mm = 0.5;
    Track& track = followed.track;
    track.is_lost = false;
    track.pose.x_nm = 500'000'000;
    track.pose.y_nm = 1'000'000'000;
    track.pose.theta_bam = 1 << 30;
    track.pose.vx_mm_s = 100;
    track.pose.vy_mm_s = 200;
    track.pose.turn_rad_s = 3;
    track.pose.covariance[0][1] = 1;
    track.pose.covariance[3][4] = 2;
    return followed;
}

TEST(RobotUpdates, ThePatternHasYUp) {
    const RobotUpdate seen = ros::update_of(followed_in_pattern(), false, 5);
    EXPECT_EQ(seen.time_ns, 5);
    ASSERT_TRUE(seen.fix);
    EXPECT_DOUBLE_EQ(seen.fix->pose.x_m, 0.5);
    EXPECT_DOUBLE_EQ(seen.fix->pose.y_m, -1);
    EXPECT_DOUBLE_EQ(seen.fix->pose.yaw_rad, -kRightAngle);
    const PlanarCovariance& covariance = *seen.fix->covariance;
    EXPECT_DOUBLE_EQ(covariance[0][0], 4 * 0.25e-6);
    EXPECT_DOUBLE_EQ(covariance[0][1], -0.25e-6);
    EXPECT_DOUBLE_EQ(covariance[1][2], 0.5 * 0.5e-3);  // y and the angle both change sign
    EXPECT_DOUBLE_EQ(covariance[2][2], 16);
    ASSERT_TRUE(seen.motion);
    EXPECT_DOUBLE_EQ(seen.motion->pose.y_m, -1);
    EXPECT_DOUBLE_EQ(seen.motion->pose.yaw_rad, -kRightAngle);
    EXPECT_DOUBLE_EQ(seen.motion->vx_m_s, 0.1);
    EXPECT_DOUBLE_EQ(seen.motion->vy_m_s, -0.2);
    EXPECT_DOUBLE_EQ(seen.motion->turn_rad_s, -3);
    EXPECT_DOUBLE_EQ(seen.motion->covariance[0][1], -1e-6);
    EXPECT_DOUBLE_EQ(seen.motion->covariance[3][4], -2e-6);
    EXPECT_EQ(seen.state, "moving");
}

TEST(RobotUpdates, TheWorldHasYUpAlready) {
    Followed followed = followed_in_pattern();
    SheetEntry entry;
    entry.world = WorldPose{3, 4, 0};
    followed.located.place = SheetPlace{&entry, 1000, 2000, kRightAngle, {}};
    const RobotUpdate seen = ros::update_of(followed, true, 0);
    EXPECT_DOUBLE_EQ(seen.fix->pose.x_m, 4);
    EXPECT_DOUBLE_EQ(seen.fix->pose.y_m, 2);
    EXPECT_NEAR(seen.fix->pose.yaw_rad, -kRightAngle, 1e-12);
    EXPECT_FALSE(seen.fix->covariance);
    EXPECT_DOUBLE_EQ(seen.motion->pose.y_m, 1);
    EXPECT_DOUBLE_EQ(seen.motion->vy_m_s, 0.2);
    entry.world.reset();
    EXPECT_FALSE(ros::update_of(followed, true, 0).fix);
}

/// Returns the same track as `followed_in_pattern`, but with the pose of a camera that looks
/// straight down from 20 mm above the pattern.
Followed followed_in_space() {
    Followed followed = followed_in_pattern();
    SpacePose& space = followed.located.space.emplace();
    space.camera = {500, 1000, -20, {}};
    space.covariance[0][0] = 4;
    space.covariance[0][1] = space.covariance[1][0] = 1;
    space.covariance[2][2] = 9;
    space.covariance[3][3] = 16;
    space.covariance[1][5] = space.covariance[5][1] = 2;
    return followed;
}

TEST(RobotUpdates, TheCameraIsInTheMap) {
    const RobotUpdate seen = ros::update_of(followed_in_space(), false, 5);
    const RobotMessages messages = RobotMessenger("anna", with_prefix("anna/")).messages(seen);
    ASSERT_TRUE(messages.camera);
    EXPECT_EQ(messages.camera->header.frame_id, "map");
    EXPECT_EQ(messages.camera->header.stamp.nanosec, 5U);
    const ros::Pose& pose = messages.camera->pose.pose;
    EXPECT_DOUBLE_EQ(pose.position.x, 0.5);
    EXPECT_DOUBLE_EQ(pose.position.y, -1);
    EXPECT_DOUBLE_EQ(pose.position.z, 0.02);
    // The z axis of the optical frame points down, so the rotation is half a turn about x.
    EXPECT_DOUBLE_EQ(std::abs(pose.orientation.x), 1);
    // The y and z axes of the camera and of the pattern point in the opposite direction to those of
    // the map.
    const ros::Covariance36& covariance = messages.camera->pose.covariance;
    EXPECT_DOUBLE_EQ(covariance[0], 4e-6);
    EXPECT_DOUBLE_EQ(covariance[1], -1e-6);
    EXPECT_DOUBLE_EQ(covariance[14], 9e-6);
    EXPECT_DOUBLE_EQ(covariance[21], 16);
    EXPECT_DOUBLE_EQ(covariance[11], 2e-3);
    EXPECT_DOUBLE_EQ(covariance[31], 2e-3);
    ASSERT_EQ(messages.tf->transforms.size(), 3U);
    EXPECT_EQ(messages.tf->transforms[2].header.frame_id, "map");
    EXPECT_EQ(messages.tf->transforms[2].child_frame_id, "anna/camera_optical");
    EXPECT_DOUBLE_EQ(messages.tf->transforms[2].transform.translation.z, 0.02);
}

TEST(RobotUpdates, TheCameraIsInTheMapWhileTheRobotIsLost) {
    Followed followed = followed_in_space();
    followed.track.is_lost = true;
    const RobotMessages messages =
        RobotMessenger("anna").messages(ros::update_of(followed, false, 5));
    EXPECT_FALSE(messages.odometry);
    ASSERT_TRUE(messages.tf);
    ASSERT_EQ(messages.tf->transforms.size(), 1U);
    EXPECT_EQ(messages.tf->transforms[0].child_frame_id, "camera_optical");
}

TEST(RobotUpdates, AnAmbiguousCameraIsNotPublishedButReported) {
    Followed followed = followed_in_space();
    followed.located.space->second = SecondPose{{500, 1000, -21, {}}, -2};
    const RobotMessages messages =
        RobotMessenger("anna").messages(ros::update_of(followed, false, 5));
    EXPECT_FALSE(messages.camera);
    EXPECT_EQ(messages.tf->transforms.size(), 2U);
    const auto& facts = messages.status.status.front().values;
    const auto value = [&facts](const std::string& key) {
        const auto found = std::ranges::find(facts, key, &ros::KeyValue::key);
        return found == facts.end() ? "" : found->value;
    };
    EXPECT_EQ(value("camera_is_ambiguous"), "true");
    EXPECT_EQ(value("camera_second_odds"), "0.25");
    // Odds of 2^-60 exclude the second pose.
    followed.located.space->second->odds_log2 = -60;
    EXPECT_TRUE(ros::update_of(followed, false, 5).camera);
}

TEST(RobotUpdates, TheCameraIsInTheWorldOfTheSheets) {
    Followed followed = followed_in_space();
    SheetEntry entry;
    entry.sheet.pattern.spacing_mm = 0.5;
    entry.sheet.origin = {1000, 2000};
    entry.world = WorldPose{3, 4, kRightAngle};
    followed.located.place = SheetPlace{&entry, 0, 0, 0, {}};
    const RobotUpdate seen = ros::update_of(followed, true, 0);
    ASSERT_TRUE(seen.camera);
    EXPECT_NEAR(seen.camera->x_m, 3, 1e-12);
    EXPECT_NEAR(seen.camera->y_m, 4, 1e-12);
    EXPECT_NEAR(seen.camera->z_m, 0.02, 1e-12);
    entry.world.reset();
    EXPECT_FALSE(ros::update_of(followed, true, 0).camera);
}

TEST(RobotUpdates, AFrameWithoutAFixSaysWhy) {
    Followed followed;
    followed.located.fix.status = Status::no_contrast;
    const RobotUpdate seen = ros::update_of(followed, true, 0);
    EXPECT_FALSE(seen.fix);
    EXPECT_FALSE(seen.motion);
    EXPECT_EQ(seen.state, "lost");
    EXPECT_EQ(seen.problem, message(Status::no_contrast));
}

TEST(CameraMount, IsWhereTheImageCentreIsSeenFromTheRobot) {
    Camera camera;
    camera.width_px = 201;
    camera.height_px = 101;
    camera.centre_px = {100, 50};
    camera.paper = PaperScale{.mm_per_px_x = 0.05, .mm_per_px_y = 0.05};
    camera.focal_px = 400;
    // The centre of the robot is 10 mm behind the image centre, along the image x axis.
    camera.reference_px = PixelPoint{-100, 50};
    const auto ahead = camera_mount(camera);
    ASSERT_TRUE(ahead);
    EXPECT_EQ(ahead->header.frame_id, "base_link");
    EXPECT_EQ(ahead->child_frame_id, "camera_optical");
    EXPECT_NEAR(ahead->transform.translation.x, 0.01, 1e-12);
    EXPECT_NEAR(ahead->transform.translation.y, 0, 1e-12);
    EXPECT_NEAR(ahead->transform.translation.z, 0.02, 1e-12);
    // The camera is rotated by half a turn about x, so its y axis points to the right and its z
    // axis down.
    EXPECT_NEAR(ahead->transform.rotation.x, 1, 1e-12);

    // A pinhole model also determines the height.
    Camera pinhole = camera;
    pinhole.focal_px.reset();
    pinhole.pinhole = Pinhole{400, 400, {90, 60}};
    EXPECT_NEAR(camera_mount(pinhole)->transform.translation.z, 0.02, 1e-12);

    // The heading of the robot is along the image y axis. The image x axis therefore points to the
    // left of the robot, and the camera is 10 mm to the left of the robot's centre.
    camera.theta_offset_rad = kRightAngle;
    const auto left = camera_mount(camera);
    EXPECT_NEAR(left->transform.translation.x, 0, 1e-12);
    EXPECT_NEAR(left->transform.translation.y, 0.01, 1e-12);
    // The image x axis is the robot's y axis, so the rotation maps (1, 0, 0) to (0, 1, 0).
    const ros::Quaternion& q = left->transform.rotation;
    EXPECT_NEAR(1 - 2 * (q.y * q.y + q.z * q.z), 0, 1e-12);
    EXPECT_NEAR(2 * (q.x * q.y + q.w * q.z), 1, 1e-12);
    EXPECT_NEAR(1 - 2 * (q.x * q.x + q.y * q.y), -1, 1e-12);

    camera.paper.reset();
    EXPECT_FALSE(camera_mount(camera));
}

}  // namespace
}  // namespace dotpose::test
