// Tests the CDR encoding of messages against bytes written by another serialiser (golden.txt), and
// the message types against the definitions of ROS 2.
#include <fstream>
#include <map>
#include <string>

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../paths.hpp"
#include "../temporary_directory.hpp"
#include "dotpose/tools/ros_messages.hpp"
#include "npm_readers.hpp"

namespace dotpose::test {
namespace {

using namespace ros;

std::string hex(const std::vector<std::uint8_t>& bytes) {
    std::string text;
    for (const std::uint8_t byte : bytes)
        text += fmt::format("{:02x}", byte);
    return text;
}

/// Returns the bytes that the other serialiser (golden.mjs) wrote for a type.
std::string golden(const std::string& wanted) {
    std::ifstream file(test::source_dir() + "/tests/robots/golden.txt");
    std::string type;
    for (std::string bytes; file >> type >> bytes;)
        if (type == wanted) return bytes;
    return "none";
}

constexpr Time kStamp = {1764091234, 987654321};

Covariance36 counted(double first) {
    Covariance36 covariance{};
    for (std::size_t i = 0; i < covariance.size(); ++i)
        covariance[i] = first + static_cast<double>(i) / 8;
    return covariance;
}

const PoseWithCovariance kPose = {{{1.25, -0.5, 0}, {0, 0, 0.6, 0.8}}, counted(1)};

TransformStamped transform(const std::string& frame, const std::string& child, double x) {
    return {{kStamp, frame}, child, {{x, 2, 3}, {0.5, -0.5, 0.5, -0.5}}};
}

TEST(Cdr, HasTheBytesOfAnotherSerialiser) {
    EXPECT_EQ(hex(to_cdr(PoseWithCovarianceStamped{{kStamp, "map"}, kPose})),
              golden("geometry_msgs/PoseWithCovarianceStamped"));
    const TwistWithCovariance twist = {{{0.1, 0.2, 0}, {0, 0, -3}}, counted(-7)};
    EXPECT_EQ(hex(to_cdr(Odometry{{kStamp, "odom"}, "base_link", kPose, twist})),
              golden("nav_msgs/Odometry"));
    EXPECT_EQ(
        hex(to_cdr(TFMessage{{transform("map", "odom", 1), transform("odom", "base_link", -1e9)}})),
        golden("tf2_msgs/TFMessage"));
    const DiagnosticStatus moving = {
        1, "dotpose: anna", "moving", "anna", {{"state", "moving"}, {"sheet", "table"}}};
    const DiagnosticStatus lost = {2, "", "lost", "", {}};
    EXPECT_EQ(hex(to_cdr(DiagnosticArray{{{-1, 5}, ""}, {moving, lost}})),
              golden("diagnostic_msgs/DiagnosticArray"));
    EXPECT_EQ(hex(to_cdr(CompressedImage{
                  {kStamp, "camera_optical"}, "png", {137, 80, 78, 71, 0, 255, 1}})),
              golden("sensor_msgs/CompressedImage"));
}

TEST(Cdr, CountsTheBytesOfATextAndItsEnd) {
    // The expected bytes follow the standard, in which the length of this text is 3: the two bytes
    // of UTF-8 and the terminating 0. golden.txt cannot be used here, because the serialiser that
    // wrote it counts characters instead of bytes.
    const std::string bytes = hex(to_cdr(CompressedImage{{{1, 2}, "\u00e4"}, "", {}}));
    EXPECT_EQ(bytes,
              "00010000"
              "01000000"
              "02000000"
              "03000000"
              "c3a400"
              "00"
              "01000000"
              "00"
              "000000"
              "00000000");
}

TEST(Cdr, GoldenBytesAreStillThoseOfTheOtherSerialiser) {
    DOTPOSE_NEEDS_NPM();
    std::ifstream file(test::source_dir() + "/tests/robots/golden.txt");
    const std::string kept{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(run_node("golden.mjs").output, kept);
}

TEST(Cdr, TypesAreDefinedAsInRos) {
    DOTPOSE_NEEDS_NPM();
    nlohmann::json types;
    for (const MessageType& type :
         {type_of(PoseWithCovarianceStamped{}), type_of(Odometry{}), type_of(TFMessage{}),
          type_of(DiagnosticArray{}), type_of(CompressedImage{})}) {
        types.push_back(
            {{"name", type.name}, {"definition", type.definition}, {"hash", type.hash}});
    }
    const TemporaryDirectory directory;
    const std::string path = (directory.path() / "types.json").string();
    std::ofstream(path) << types;
    const ShellOutcome check = run_node("check_definitions.mjs <'" + path + "' 2>&1");
    EXPECT_EQ(check.exit_code, 0) << check.output;
}

TEST(RosTime, CountsNanosecondsUp) {
    const auto expect = [](std::int64_t ns, std::int32_t sec, std::uint32_t nanosec) {
        const Time time = ros_time(ns);
        EXPECT_EQ(time.sec, sec) << ns;
        EXPECT_EQ(time.nanosec, nanosec) << ns;
    };
    expect(0, 0, 0);
    expect(1'764'091'234'987'654'321, 1764091234, 987654321);
    expect(-1, -1, 999'999'999);
    expect(-1'000'000'000, -1, 0);
    expect(2'147'483'648'000'000'000, 2147483647, 999'999'999);
    expect(std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int32_t>::min(), 0);
}

}  // namespace
}  // namespace dotpose::test
