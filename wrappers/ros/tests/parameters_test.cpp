// Tests the parameters of the node: their types and ranges, and the files that they name.
#include "parameters.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <dotpose/files/camera_file.hpp>

#include "temporary_directory.hpp"

namespace dotpose_ros {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::map<std::string, Value> standards() {
    std::map<std::string, Value> values;
    for (const Parameter& parameter : parameters())
        values[parameter.name] = parameter.standard;
    return values;
}

Settings with(const std::string& name, const Value& value) {
    auto values = standards();
    values.at(name) = value;
    return settings_of(values);
}

std::string problem_of(const std::string& name, const Value& value) {
    try {
        with(name, value);
    } catch (const dotpose::Error& error) {
        return error.what();
    }
    return "accepted";
}

TEST(RosParameters, AreThoseOfTheLibraryWhereNothingIsSet) {
    const Settings settings = settings_of(standards());
    const dotpose::TrackOptions track;
    EXPECT_FLOAT_EQ(settings.follower.track.max_speed_mm_s, track.max_speed_mm_s);
    EXPECT_FLOAT_EQ(settings.follower.track.acceleration_mm_s2, track.acceleration_mm_s2);
    EXPECT_EQ(settings.follower.spacing_mm, dotpose::kDefaultSpacing_mm);
    EXPECT_EQ(settings.frames.base, "base_link");
    EXPECT_EQ(settings.half_exposure_ns, 0);
    EXPECT_FALSE(settings.is_reliable);
    EXPECT_TRUE(settings.publishes_tf);
}

TEST(RosParameters, NumbersMayBeWhole) {
    EXPECT_EQ(with("max_speed_m_s", std::int64_t{2}).follower.track.max_speed_mm_s, 2000);
    EXPECT_EQ(with("max_speed_m_s", 0.5).follower.track.max_speed_mm_s, 500);
    EXPECT_EQ(with("exposure_us", std::int64_t{300}).half_exposure_ns, 150'000);
}

TEST(RosParameters, ACameraMayMirror) {
    EXPECT_FALSE(settings_of(standards()).follower.flip);
    EXPECT_TRUE(with("flip", true).follower.flip);
}

TEST(RosParameters, RefusesNumbersThatMeanNothing) {
    for (const char* name : {"max_speed_m_s", "acceleration_m_s2", "spacing_mm", "exposure_us"}) {
        for (const double number : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
            EXPECT_THAT(problem_of(name, number),
                        AllOf(HasSubstr(name), HasSubstr("must be from")));
        EXPECT_THAT(problem_of(name, "fast"), HasSubstr("must be a number"));
    }
    EXPECT_THAT(problem_of("spacing_mm", std::int64_t{0}), HasSubstr("must be from 0.01 to 100"));
    EXPECT_THAT(problem_of("reliable", std::int64_t{1}), HasSubstr("must be true or false"));
    EXPECT_THAT(problem_of("sheets", std::int64_t{1}), HasSubstr("must be a string"));
}

TEST(RosParameters, ThePrefixIsOfTheRobotsOwnFrames) {
    auto values = standards();
    values.at("frame_prefix") = "anna/";
    values.at("camera_frame") = "eye";
    const Settings settings = settings_of(values);
    EXPECT_EQ(settings.frames.map, "map");
    EXPECT_EQ(settings.frames.odom, "anna/odom");
    EXPECT_EQ(settings.frames.base, "anna/base_link");
    EXPECT_EQ(settings.frames.camera, "anna/eye");
    EXPECT_THAT(problem_of("frame_prefix", "/anna/"), HasSubstr("frame prefix '/anna/'"));
    EXPECT_THAT(problem_of("base_frame", ""), HasSubstr("frame ''"));
}

TEST(RosParameters, TheExposureIsThatOfTheCameraFile) {
    const dotpose::test::TemporaryDirectory directory;
    const std::string path = (directory.path() / "camera.yaml").string();
    dotpose::Camera camera;
    camera.width_px = 320;
    camera.height_px = 240;
    camera.centre_px = {159.5, 119.5};
    camera.exposure_us = 400;
    dotpose::write_camera(path, camera);
    auto values = standards();
    values.at("camera") = path;
    EXPECT_EQ(settings_of(values).half_exposure_ns, 200'000);
    values.at("exposure_us") = std::int64_t{0};
    EXPECT_EQ(settings_of(values).half_exposure_ns, 0);
    EXPECT_THAT(problem_of("camera", "nowhere.yaml"), HasSubstr("nowhere.yaml"));
}

}  // namespace
}  // namespace dotpose_ros
