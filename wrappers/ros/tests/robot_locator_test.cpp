// Tests RobotLocator without ROS: its handling of stamps, lenses and diagnostics.
#include "robot_locator.hpp"

#include <cmath>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <dotpose/tools/simulate.hpp>

namespace dotpose_ros {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::int64_t kStep_ns = 10'000'000;
constexpr std::int64_t kStart_ns = 1'000'000'000'000;
constexpr std::uint8_t kOk = 0;
constexpr std::uint8_t kWarning = 1;
constexpr std::uint8_t kError = 2;

Settings settings_with(const std::string& name = "spacing_mm",
                       const Value& value = dotpose::kDefaultSpacing_mm) {
    std::map<std::string, Value> values;
    for (const Parameter& parameter : parameters())
        values[parameter.name] = parameter.standard;
    values.at(name) = value;
    return settings_of(values);
}

/// A camera at rest above the pattern, and a locator that processes its images.
class RosLocator : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        dotpose::CameraPose pose;
        pose.cell = {100'000, 200'000};
        grey_ = render(dotpose::Pattern{}, dotpose::CameraModel{}, pose, {}, 1);
    }

    static RawImage image() {
        const auto width = static_cast<std::uint32_t>(grey_.width_px);
        return {"mono8", width, static_cast<std::uint32_t>(grey_.height_px),
                width,   false, grey_.pixels};
    }

    /// Passes an image with the stamp of frame number `frame` to the locator. Images arrive every
    /// 10 ms.
    RobotLocator::Answer take(int frame, const RawImage& image = RosLocator::image()) {
        arrival_ns_ += kStep_ns;
        return locator_.take(image, kStart_ns + frame * kStep_ns, arrival_ns_);
    }

    /// Passes images to the locator until it publishes a status. Returns the status. Fails if there
    /// is none within a second.
    dotpose::ros::DiagnosticStatus status_from(int frame,
                                               const RawImage& image = RosLocator::image()) {
        for (int i = 0; i <= 100; ++i) {
            const auto answer = take(frame + i, image);
            if (!answer.messages.status.status.empty())
                return answer.messages.status.status.front();
        }
        ADD_FAILURE() << "no status in a second";
        return {};
    }

    inline static dotpose::GreyImage grey_;
    RobotLocator locator_{settings_with(), "anna"};
    std::int64_t arrival_ns_ = 0;
};

TEST_F(RosLocator, GivesPoseOdometryAndTransforms) {
    const auto answer = take(0);
    ASSERT_TRUE(answer.messages.pose);
    // The camera is at cell (100,000, 200,000). Messages are in metres with y up.
    EXPECT_NEAR(answer.messages.pose->pose.pose.position.x, 100'000 * 0.508e-3, 1e-5);
    EXPECT_NEAR(answer.messages.pose->pose.pose.position.y, -200'000 * 0.508e-3, 1e-5);
    EXPECT_EQ(answer.messages.pose->header.stamp.sec, 1000);
    EXPECT_TRUE(answer.messages.odometry);
    EXPECT_TRUE(answer.messages.tf);
    EXPECT_EQ(answer.messages.status.status.front().level, kOk);
    EXPECT_EQ(answer.warning, "");
}

TEST_F(RosLocator, DiagnosticsComeAtChangesAndOnceASecond) {
    int messages = 0;
    for (int i = 0; i < 300; ++i)
        messages += static_cast<int>(take(i).messages.status.status.size());
    // A status is published for the first image, for the image at which the robot comes to rest,
    // and then once per second.
    EXPECT_GE(messages, 3);
    EXPECT_LE(messages, 5);
}

TEST_F(RosLocator, StampsMayBeNegative) {
    EXPECT_EQ(nanoseconds(-1, 999'999'999), -1);
    const auto answer = take(-200'000);
    ASSERT_TRUE(answer.messages.pose);
    EXPECT_EQ(answer.messages.pose->header.stamp.sec, -1000);
    EXPECT_TRUE(take(-199'999).messages.odometry);
}

TEST_F(RosLocator, StampsAreOfTheMiddleOfTheExposure) {
    RobotLocator locator(settings_with("exposure_us", std::int64_t{1000}), "anna");
    const auto answer = locator.take(image(), kStart_ns, 0);
    ASSERT_TRUE(answer.messages.pose);
    EXPECT_EQ(answer.messages.pose->header.stamp.sec, 999);
    EXPECT_EQ(answer.messages.pose->header.stamp.nanosec, 999'500'000U);
}

TEST_F(RosLocator, AnImageThatComesTwiceOrLateIsLeftOut) {
    take(0);
    EXPECT_TRUE(take(2).messages.odometry);
    for (const int frame : {2, 1}) {
        const auto answer = take(frame);
        EXPECT_FALSE(answer.messages.pose);
        EXPECT_FALSE(answer.messages.tf);
        EXPECT_TRUE(answer.messages.status.status.empty());
        EXPECT_EQ(answer.warning, "");
    }
    EXPECT_TRUE(take(3).messages.odometry);
}

TEST_F(RosLocator, SaysThatStampsStandStill) {
    take(5);
    std::string warnings;
    dotpose::ros::RobotMessages last;
    for (int i = 0; i < 10; ++i) {
        const auto answer = take(5);
        EXPECT_FALSE(answer.messages.odometry);
        warnings += answer.warning;
        if (!answer.messages.status.status.empty()) last = answer.messages;
    }
    EXPECT_EQ(warnings,
              "images are skipped because their stamps do not increase; correct the clock of the "
              "camera driver");
    ASSERT_EQ(last.status.status.size(), 1U);
    EXPECT_EQ(last.status.status.front().level, kError);
    EXPECT_THAT(last.status.status.front().message, HasSubstr("do not increase"));
    EXPECT_EQ(status_from(6).level, kOk);
}

TEST_F(RosLocator, FollowsARecordingThatBeginsAnew) {
    for (int i = 0; i < 50; ++i)
        take(i);
    EXPECT_FALSE(take(0).messages.odometry);
    const auto answer = take(1);
    EXPECT_THAT(answer.warning, HasSubstr("went back"));
    ASSERT_TRUE(answer.messages.odometry);
    EXPECT_EQ(answer.messages.odometry->header.stamp.nanosec, kStep_ns);
    for (int i = 2; i < 50; ++i)
        EXPECT_TRUE(take(i).messages.odometry) << i;
}

TEST_F(RosLocator, SaysWhatIsWrongWithImages) {
    take(0);
    RawImage wrong = image();
    wrong.encoding = "32FC1";
    const auto answer = take(1, wrong);
    EXPECT_FALSE(answer.messages.pose);
    EXPECT_THAT(answer.warning, HasSubstr("'32FC1'"));
    ASSERT_EQ(answer.messages.status.status.size(), 1U);
    EXPECT_EQ(answer.messages.status.status.front().level, kError);
    EXPECT_THAT(answer.messages.status.status.front().message,
                AllOf(HasSubstr("'32FC1'"), HasSubstr("set the camera's driver to mono8")));
    // The warning is logged only once, and no status is due before a second has passed.
    const auto next = take(2, wrong);
    EXPECT_EQ(next.warning, "");
    EXPECT_TRUE(next.messages.status.status.empty());
    EXPECT_TRUE(take(3).messages.pose);
}

TEST_F(RosLocator, ReadsColour) {
    std::vector<std::uint8_t> bgr;
    for (const std::uint8_t level : grey_.pixels)
        bgr.insert(bgr.end(), 3, level);
    RawImage colour = image();
    colour.encoding = "bgr8";
    colour.step *= 3;
    colour.data = bgr;
    const auto pose = take(0).messages.pose;
    const auto of_colour = take(1, colour).messages.pose;
    ASSERT_TRUE(pose && of_colour);
    EXPECT_NEAR(of_colour->pose.pose.position.x, pose->pose.pose.position.x, 1e-7);
}

TEST_F(RosLocator, AMosaicLosesLittle) {
    // The dots are grey, so red, green and blue pixels of the mosaic have the same level.
    RawImage mosaic = image();
    mosaic.encoding = "bayer_grbg8";
    const auto pose = take(0).messages.pose;
    const auto of_mosaic = take(1, mosaic).messages.pose;
    ASSERT_TRUE(pose && of_mosaic);
    EXPECT_NEAR(of_mosaic->pose.pose.position.x, pose->pose.pose.position.x, 1e-6);
    EXPECT_NEAR(of_mosaic->pose.pose.position.y, pose->pose.pose.position.y, 1e-6);
}

Lens lens_of(std::uint32_t width, std::uint32_t height) {
    return {width, height, "plumb_bob", {300, 0, 93.5, 0, 300, 59.5, 0, 0, 1}, {0, 0, 0, 0, 0}};
}

TEST_F(RosLocator, TakesTheFirstLensThatItCanUse) {
    Lens none = lens_of(188, 120);
    none.k = {};
    EXPECT_THAT(locator_.take(none), HasSubstr("never calibrated"));
    EXPECT_EQ(locator_.take(none),
              "");  // the problem is reported only once, although each image has a camera_info
    EXPECT_EQ(status_from(0).level, kOk);

    Lens fisheye = lens_of(188, 120);
    fisheye.distortion_model = "equidistant";
    EXPECT_THAT(locator_.take(fisheye),
                AllOf(HasSubstr("camera_info: distortion_model"), testing::Not(HasSubstr("/tmp"))));
    const auto status = status_from(101);
    EXPECT_EQ(status.level, kWarning);
    EXPECT_THAT(status.message, HasSubstr("located without a lens"));

    EXPECT_EQ(locator_.take(lens_of(188, 120)), "");
    EXPECT_EQ(locator_.take(fisheye), "");
    EXPECT_EQ(status_from(202).level, kOk);
}

TEST_F(RosLocator, TheCameraHasAPoseInSpaceIfAskedFor) {
    RobotLocator locator(settings_with("space", true), "anna");
    EXPECT_TRUE(locator.has_space_pose());
    const auto before = locator.take(image(), kStart_ns, 0);
    EXPECT_TRUE(before.messages.pose);
    EXPECT_FALSE(before.messages.camera);
    EXPECT_THAT(before.messages.status.status.front().message,
                HasSubstr("no poses in space until"));

    // The simulated camera is 16 mm above cell (100,000, 200,000), and looks straight down. The
    // optical frame is rotated by half a turn about x, because its z axis points down.
    const dotpose::CameraModel model;
    Lens lens = lens_of(188, 120);
    lens.k[0] = lens.k[4] = model.working_distance_mm / model.mm_per_px;
    EXPECT_EQ(locator.take(lens), "");
    const auto answer = locator.take(image(), kStart_ns + kStep_ns, kStep_ns);
    ASSERT_TRUE(answer.messages.camera);
    EXPECT_EQ(answer.messages.camera->header.frame_id, "map");
    const dotpose::ros::Pose& pose = answer.messages.camera->pose.pose;
    EXPECT_NEAR(pose.position.x, 100'000 * 0.508e-3, 1e-4);
    EXPECT_NEAR(pose.position.y, -200'000 * 0.508e-3, 1e-4);
    EXPECT_NEAR(pose.position.z, 0.016, 1e-4);
    EXPECT_NEAR(std::abs(pose.orientation.x), 1, 1e-4);
    const auto& camera = answer.messages.tf->transforms.back();
    EXPECT_EQ(camera.header.frame_id, "map");
    EXPECT_EQ(camera.child_frame_id, "camera_optical");
    EXPECT_EQ(camera.transform.translation.z, pose.position.z);
    EXPECT_THAT(answer.messages.status.status.front().message, testing::Not(HasSubstr("in space")));
    EXPECT_FALSE(locator.mount(0));
    EXPECT_FALSE(take(0).messages.camera);
}

TEST_F(RosLocator, ImagesHaveTheSizeOfTheLens) {
    EXPECT_EQ(locator_.take(lens_of(640, 480)), "");
    const auto answer = take(0);
    EXPECT_FALSE(answer.messages.pose);
    EXPECT_THAT(answer.warning, AllOf(HasSubstr("188 x 120 px"), HasSubstr("640 x 480"),
                                      HasSubstr("set the camera to that size")));
}

}  // namespace
}  // namespace dotpose_ros
