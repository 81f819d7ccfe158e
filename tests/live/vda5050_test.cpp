// Checks the messages of `dotpose watch --mqtt` against VDA 5050, version 2.0.0. The JSON schemas
// in this file contain the required fields, types and ranges from the tables in sections 6.11 and
// 6.14 of VDA 5050.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../drive.hpp"
#include "../json_schema.hpp"
#include "dotpose/tools/image_file.hpp"
#include "mqtt_fixture.hpp"

namespace dotpose::test {
namespace {

using nlohmann::json;

const json kHeader = {{"headerId", {{"type", "integer"}, {"minimum", 0}}},
                      {"timestamp", {{"type", "string"}}},
                      {"version", {{"type", "string"}}},
                      {"manufacturer", {{"type", "string"}}},
                      {"serialNumber", {{"type", "string"}}}};
const json kHeaderKeys = {"headerId", "timestamp", "version", "manufacturer", "serialNumber"};

JsonSchema visualization() {
    const json number = {{"type", "number"}};
    json properties = kHeader;
    properties["agvPosition"] = {
        {"type", "object"},
        {"required", {"x", "y", "theta", "mapId", "positionInitialized"}},
        {"properties",
         {{"x", number},
          {"y", number},
          {"theta", {{"type", "number"}, {"minimum", -3.14159265359}, {"maximum", 3.14159265359}}},
          {"mapId", {{"type", "string"}}},
          {"positionInitialized", {{"type", "boolean"}}},
          {"localizationScore", {{"type", "number"}, {"minimum", 0}, {"maximum", 1}}},
          {"deviationRange", number}}}};
    properties["velocity"] = {{"type", "object"},
                              {"properties", {{"vx", number}, {"vy", number}, {"omega", number}}}};
    return JsonSchema({{"type", "object"}, {"required", kHeaderKeys}, {"properties", properties}});
}

JsonSchema connection() {
    json properties = kHeader;
    properties["connectionState"] = {{"type", "string"},
                                     {"enum", {"ONLINE", "OFFLINE", "CONNECTIONBROKEN"}}};
    json required = kHeaderKeys;
    required.push_back("connectionState");
    return JsonSchema({{"type", "object"}, {"required", required}, {"properties", properties}});
}

/// Regular expression for a UTC time in ISO 8601 format.
constexpr const char* kTimestamp =
    "^[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}\\.[0-9]+Z$";

class Vda5050 : public Mqtt {
  protected:
    /// Runs `dotpose watch` on ten frames from a robot. The last five frames show no pattern.
    void watch(const Broker& broker) {
        const DriveCamera camera(188, 120);
        for (int i = 0; i < 10; ++i) {
            GreyImage image = camera.frame(Drive(), 240 + i);
            if (i >= 5) std::ranges::fill(image.pixels, 200);
            write_pgm(directory_ / fmt::format("f{}.pgm", i), image.view());
        }
        ASSERT_EQ(run("watch 'f*.pgm' --fps 20 --robot anna --qos 1 --mqtt " + broker.url()), 0)
            << errors_;
    }
};

TEST_F(Vda5050, MessagesAreValid) {
    const Broker broker(directory_);
    // Creates a persistent session. The broker queues all messages for it until the reader connects
    // again.
    const std::string reader = fmt::format(
        "mosquitto_sub -h 127.0.0.1 -p {} -c -i reader -q 1 -v -t 'uagv/v2/#' ", broker.port());
    shell(reader + "-E");
    watch(broker);
    int poses = 0;
    std::vector<std::string> subjects;
    std::istringstream lines(shell(reader + "-C 12 -W 5"));
    for (std::string line; std::getline(lines, line);) {
        const std::string topic = line.substr(0, line.find(' '));
        const json message = json::parse(line.substr(topic.size() + 1));
        subjects.push_back(topic.substr(topic.rfind('/') + 1));
        ASSERT_THAT(topic, testing::StartsWith("uagv/v2/dotpose/anna/"));
        const bool is_connection = subjects.back() == "connection";
        const JsonSchema schema = is_connection ? connection() : visualization();
        EXPECT_THAT(schema.check(message).errors, testing::IsEmpty()) << line;
        EXPECT_EQ(message["version"], "2.0.0");
        EXPECT_EQ(message["manufacturer"], "dotpose");
        EXPECT_EQ(message["serialNumber"], "anna");
        EXPECT_THAT(message["timestamp"].get<std::string>(), testing::ContainsRegex(kTimestamp));
        poses += message.contains("agvPosition");
    }
    EXPECT_EQ(std::ranges::count(subjects, "connection"), 2);
    EXPECT_EQ(std::ranges::count(subjects, "visualization"), 10);
    EXPECT_GE(poses, 5);
    EXPECT_LT(poses, 10);  // a lost robot publishes no pose
}

TEST_F(Vda5050, ASubscriberThatComesLateLearnsThatTheRobotHasLeft) {
    const Broker broker(directory_);
    watch(broker);
    const json message = json::parse(shell(
        fmt::format("mosquitto_sub -h 127.0.0.1 -p {} -t 'uagv/v2/#' -C 1 -W 5", broker.port())));
    EXPECT_EQ(message["connectionState"], "OFFLINE");
    EXPECT_EQ(message["headerId"], 2);  // number 0 is the last will, and number 1 is ONLINE
}

}  // namespace
}  // namespace dotpose::test
