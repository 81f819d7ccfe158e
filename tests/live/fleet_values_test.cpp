// Tests the values that `dotpose fleet --web` sends to its page, at simulated times and without a
// broker.
#include "fleet_values.hpp"

#include <cstring>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "fleet_map_values.hpp"
#include "fleet_receiver.hpp"

namespace dotpose::test {
namespace {

using cli::Delivery;
using cli::FleetSnapshot;
using nlohmann::json;
using serve::Command;
using testing::ElementsAre;

FleetSnapshot snapshot_of(const Receiver& r) {
    return {r.fleet.robots(r.now()), r.now()};
}

cli::FleetMap hall() {
    cli::FleetMap map;
    map.id = "hall";
    map.names = {"dock"};
    map.outlines = {{"dock", {{{0, 0}, {100, 0}, {100, 50}, {0, 50}}}}};
    return map;
}

std::vector<std::string> names_in(const json& rows) {
    std::vector<std::string> names;
    for (const json& row : rows)
        names.push_back(row["name"]);
    return names;
}

json table_of(const Receiver& r, Command request) {
    request.arguments.emplace("rows", 100.0);
    return json::parse(table_value(snapshot_of(r), hall(), Delivery::all, request));
}

/// Receives the states of four robots. One is silent, one is lost, and one is on an unknown sheet.
void receive_four(Receiver& r) {
    r.receive({.robot = "silent1", .x_m = 0.5, .map = "hall"});
    r.pass(6);
    r.receive({.robot = "robot10", .x_m = 1, .y_m = 2, .map = "hall", .sheet = "dock"});
    r.receive({.robot = "robot2", .map = "hall", .sheet = "Shelf"});
    r.receive({.robot = "lost1", .map = "hall"});
    r.receive({.robot = "lost1", .state = "lost", .is_localized = false, .reason = "no_grid"});
}

TEST(FleetValues, RowsAreOrderedAndFiltered) {
    Receiver r;
    receive_four(r);
    EXPECT_THAT(names_in(table_of(r, {"", {{"order", "name"}}})["rows"]),
                ElementsAre("lost1", "robot2", "robot10", "silent1"));
    EXPECT_THAT(names_in(table_of(r, {"", {{"order", "attention"}}})["rows"]),
                ElementsAre("silent1", "lost1", "robot2", "robot10"));
    EXPECT_THAT(names_in(table_of(r, {"", {{"show", "attention"}}})["rows"]),
                ElementsAre("lost1", "robot2", "silent1"));
    EXPECT_THAT(names_in(table_of(r, {"", {{"show", "unknown"}}})["rows"]), ElementsAre("robot2"));
    EXPECT_THAT(names_in(table_of(r, {"", {{"show", "moving"}}})["rows"]),
                ElementsAre("robot2", "robot10"));
    EXPECT_THAT(names_in(table_of(r, {"", {{"filter", "shELF"}}})["rows"]), ElementsAre("robot2"));
    EXPECT_THAT(names_in(table_of(r, {"", {{"filter", "no grid"}}})["rows"]), ElementsAre("lost1"));
    EXPECT_THAT(names_in(table_of(r, {"", {{"filter", "nothing"}}})["rows"]), ElementsAre());
}

TEST(FleetValues, RowsContainPlaceAndSpeedOnlyIfTheyAreKnown) {
    Receiver r;
    receive_four(r);
    const json rows = table_of(r, {"", {{"order", "name"}}})["rows"];
    EXPECT_EQ(rows[0]["state"], "lost");
    EXPECT_EQ(rows[0]["reason"], "no grid");
    EXPECT_EQ(rows[0]["map"], "hall");
    EXPECT_FALSE(rows[0].contains("x_mm"));
    EXPECT_FALSE(rows[0].contains("speed_mm_s"));
    EXPECT_EQ(rows[1]["is_known"], false);
    EXPECT_EQ(rows[2]["is_known"], true);
    EXPECT_EQ(rows[2]["x_mm"], 1000);
    EXPECT_EQ(rows[2]["y_mm"], 2000);
    EXPECT_EQ(rows[2]["speed_mm_s"], 500);
    EXPECT_EQ(rows[3]["age_s"], 6);
    EXPECT_FALSE(rows[3].contains("speed_mm_s"));
}

TEST(FleetValues, PagesOfTheTable) {
    Receiver r;
    for (int i = 0; i < 30; ++i)
        r.receive({.robot = fmt::format("r{}", i)});
    const auto page = [&r](double first, double rows) {
        return json::parse(table_value(snapshot_of(r), {}, Delivery::all,
                                       {"", {{"first", first}, {"rows", rows}}}));
    };
    EXPECT_THAT(names_in(page(8, 3)["rows"]), ElementsAre("r8", "r9", "r10"));
    EXPECT_EQ(page(8, 3)["matching"], 30);
    // If the requested page is beyond the last page, the last page is returned.
    EXPECT_THAT(names_in(page(1e300, 3)["rows"]), ElementsAre("r27", "r28", "r29"));
    EXPECT_EQ(page(1e300, 3)["first"], 27);
    EXPECT_EQ(page(-5, 1e300)["rows"].size(), 30U);
    EXPECT_EQ(page(0, -1)["rows"].size(), 0U);
}

TEST(FleetValues, SummaryCountsRobotsByStateAndMap) {
    Receiver r;
    receive_four(r);
    r.receive({.robot = "astray", .x_m = -3, .map = "cellar"});
    std::deque<cli::RobotAlert> alerts(2);
    alerts[0].robot = "older";
    alerts[1].robot = "newer";
    const json summary = json::parse(
        summary_value(snapshot_of(r), r.fleet, hall(), {true, Delivery::all, {}}, 12.34, alerts));
    EXPECT_EQ(summary["robots"], 5);
    EXPECT_EQ(summary["states"],
              json::parse(R"({"moving": 3, "still": 0, "lost": 1, "silent": 1, "gone": 0})"));
    EXPECT_EQ(summary["unknown"], 2);
    EXPECT_EQ(summary["states_per_s"], 12.3);
    EXPECT_EQ(summary["maps"][0]["name"], "hall");
    EXPECT_EQ(summary["maps"][0]["robots"], 4);
    EXPECT_EQ(summary["maps"][0]["x_mm"], json({0, 1000}));
    EXPECT_EQ(summary["maps"][1]["x_mm"], json({-3000, -3000}));
    EXPECT_EQ(summary["alerts"][0]["robot"], "newer");
}

TEST(FleetValues, NamesCannotControlWhatShowsThem) {
    Receiver r;
    r.receive({.robot = "a\x1b[2J", .map = "m\xe2\x80\xae", .sheet = "<b>"});
    const json row = json::parse(
        table_value(snapshot_of(r), {}, Delivery::all, {"", {{"rows", 1.0}}}))["rows"][0];
    EXPECT_EQ(row["name"], "a\xef\xbf\xbd[2J");
    EXPECT_EQ(row["map"], "m\xef\xbf\xbd");
    EXPECT_EQ(row["sheet"], "<b>");
}

TEST(FleetValues, OneRobotWithItsPathAndAlerts) {
    Receiver r;
    r.receive({.robot = "anna", .x_m = 1});
    r.receive({.robot = "anna", .x_m = 2});
    std::deque<cli::RobotAlert> alerts(2);
    alerts[0].robot = "anna";
    alerts[1].robot = "bert";
    const auto value = [&](double id) {
        return json::parse(
            robot_value(snapshot_of(r), r.fleet, {}, Delivery::all, alerts, {"", {{"robot", id}}}));
    };
    const json anna = value(r.robot("anna").id);
    EXPECT_EQ(anna["path_mm"], json({1000, 0, 2000, 0}));
    EXPECT_EQ(anna["events"].size(), 1U);
    EXPECT_EQ(value(77), nullptr);
}

/// A map message sent by the fleet. It consists of the size of the header, the header in JSON, and
/// binary records.
struct MapMessage {
    explicit MapMessage(const std::string& bytes) {
        std::uint32_t size = 0;
        std::memcpy(&size, bytes.data(), 4);
        head = json::parse(bytes.substr(4, size));
        records = bytes.substr(4 + size);
    }
    template <typename T>
    T at(std::size_t offset) const {
        T value;
        std::memcpy(&value, records.data() + offset, sizeof value);
        return value;
    }
    json head;
    std::string records;
};

TEST(FleetMapValues, PositionsInTheWindow) {
    Receiver r;
    for (int i = 0; i < 5; ++i)
        r.receive({.robot = fmt::format("r{}", i), .x_m = static_cast<double>(i)});
    r.receive({.robot = "z", .x_m = 2, .map = "cellar"});
    r.receive({.robot = "never", .state = "lost", .is_localized = false});
    const Command request{
        "",
        {{"map", "table"}, {"x_min", 500.0}, {"x_max", 2500.0}, {"y_min", -9.0}, {"y_max", 9.0}}};
    const MapMessage message(positions_value(snapshot_of(r), {}, request));
    EXPECT_EQ(message.head["names"], json({"r1", "r2"}));
    EXPECT_EQ(message.head["origin_mm"], json({1500, 0}));
    ASSERT_EQ(message.records.size(), 32U);
    EXPECT_EQ(message.at<std::uint32_t>(16), r.robot("r2").id);
    EXPECT_FLOAT_EQ(message.at<float>(20), 500);
    EXPECT_FLOAT_EQ(message.at<float>(24), 0);
    EXPECT_EQ(message.at<std::int16_t>(28), 0);
    EXPECT_EQ(message.at<std::uint8_t>(30), 0);  // moving
    EXPECT_EQ(message.at<std::uint8_t>(31), 1);  // flags: 1 for a heading, 2 for an unknown sheet
    EXPECT_EQ(MapMessage(positions_value(snapshot_of(r), {}, {})).head["count"], 5);
}

TEST(FleetMapValues, PositionsFarFromTheOriginAreExact) {
    Receiver r;
    r.receive({.robot = "a", .x_m = 208'000.123456, .map = "pattern-0"});
    const MapMessage message(positions_value(snapshot_of(r), {}, {}));
    EXPECT_NEAR(
        message.head["origin_mm"][0].get<double>() + static_cast<double>(message.at<float>(4)),
        208'000'123.456, 1e-3);
}

TEST(FleetMapValues, TrailsAreLimitedInTotal) {
    Receiver r;
    for (int point = 0; point < 250; ++point) {
        for (int i = 0; i < 150; ++i)
            r.receive({.robot = fmt::format("r{}", i), .x_m = point * 0.01});
    }
    const MapMessage message(trails_value(snapshot_of(r), r.fleet, {}, {}));
    EXPECT_EQ(message.head["count"], 150);
    const auto points = message.at<std::uint32_t>(4);
    EXPECT_EQ(points, 100U);  // every other point of the newest 200 points
    EXPECT_LE(150 * points, cli::kMaxTrailPoints);
    EXPECT_EQ(message.records.size(), 150 * (8 + 8 * points));
    const double origin_mm = message.head["origin_mm"][0];
    EXPECT_NEAR(origin_mm + static_cast<double>(message.at<float>(8)), 500, 0.01);
}

TEST(FleetMapValues, APathDoesNotContinueOnAnotherMap) {
    Receiver r;
    r.receive({.robot = "a", .x_m = 1, .map = "hall"});
    r.receive({.robot = "a", .x_m = 5, .map = "cellar"});
    r.receive({.robot = "a", .state = "lost", .is_localized = false});
    r.receive({.robot = "a", .x_m = 6, .map = "cellar"});
    EXPECT_EQ(r.fleet.path_mm("a").size(), 2U);
}

}  // namespace
}  // namespace dotpose::test
