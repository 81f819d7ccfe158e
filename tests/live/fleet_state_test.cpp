// Tests robot conditions, alerts, and the sorting and paging of the table. Uses simulated times and
// no broker.
#include "fleet_state.hpp"

#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fleet_alerts.hpp"
#include "fleet_page.hpp"
#include "fleet_receiver.hpp"
#include "natural_order.hpp"

namespace dotpose::test {
namespace {

using cli::AlertWatch;
using cli::Condition;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST(FleetConditions, FollowTheStatesAndTheSilence) {
    Receiver r;
    r.receive({.robot = "anna"});
    EXPECT_EQ(r.condition("anna"), Condition::moving);
    r.receive({.robot = "anna", .state = "stationary"});
    EXPECT_EQ(r.condition("anna"), Condition::still);
    r.receive({.robot = "anna", .state = "lost", .is_localized = false, .reason = "no_grid"});
    EXPECT_EQ(r.condition("anna"), Condition::lost);
    EXPECT_EQ(r.robot("anna").reason, "no grid");
    EXPECT_EQ(r.robot("anna").newest.map_id, "table");
    r.receive({.robot = "anna"});
    r.pass(4.9);
    EXPECT_EQ(r.condition("anna"), Condition::moving);
    r.pass(0.2);
    EXPECT_EQ(r.condition("anna"), Condition::silent);
    EXPECT_EQ(r.robot("anna").reason, "no message");
    r.pass(54.8);
    EXPECT_EQ(r.condition("anna"), Condition::silent);
    r.pass(0.2);
    EXPECT_EQ(r.condition("anna"), Condition::gone);
    r.receive({.robot = "anna"});
    EXPECT_EQ(r.condition("anna"), Condition::moving);
}

TEST(FleetConditions, FollowTheConnection) {
    Receiver r;
    r.receive({.robot = "anna"});
    // The broker publishes the robot's last will. It contains the time at which the robot
    // connected, an hour ago.
    r.connect("anna", "CONNECTIONBROKEN", 3600 * kSecond);
    EXPECT_EQ(r.condition("anna"), Condition::silent);
    EXPECT_EQ(r.robot("anna").reason, "connection broke");
    r.connect("anna", "ONLINE");
    r.receive({.robot = "anna"});
    EXPECT_EQ(r.condition("anna"), Condition::moving);
    r.connect("anna", "OFFLINE");
    EXPECT_EQ(r.condition("anna"), Condition::gone);
    EXPECT_EQ(r.robot("anna").reason, "disconnected");
    // The fleet receives retained messages from robots that have sent no state since the fleet was
    // started.
    r.connect("bert", "ONLINE");
    EXPECT_EQ(r.condition("bert"), Condition::lost);
    EXPECT_EQ(r.robot("bert").reason, "no state yet");
    r.connect("carl", "CONNECTIONBROKEN", 3600 * kSecond);
    EXPECT_EQ(r.condition("carl"), Condition::gone);
}

TEST(FleetConditions, AStateThatWaitedInAQueueIsOld) {
    Receiver r;
    r.receive({.robot = "anna"}, 2000);
    r.pass(20);
    r.receive({.robot = "anna"}, 10 * kSecond);
    EXPECT_EQ(r.condition("anna"), Condition::silent);
    EXPECT_NEAR(static_cast<double>(r.robot("anna").silence_us) * 1e-6, 10, 0.01);
}

TEST(FleetConditions, AnyOffsetOfTheRobotsClockIsAccepted) {
    for (const std::int64_t skew_us : {-3600 * kSecond, 3600 * kSecond}) {
        Receiver r;
        for (int i = 0; i < 20; ++i) {
            r.receive({.robot = "anna"}, 2000, skew_us);
            r.pass(1);
        }
        EXPECT_EQ(r.condition("anna"), Condition::moving) << skew_us;
        r.pass(5);
        EXPECT_EQ(r.condition("anna"), Condition::silent) << skew_us;
    }
}

TEST(FleetConditions, AClockThatIsSetBackOrDriftsDoesNotSilenceARobot) {
    Receiver r;
    r.receive({.robot = "anna"});
    r.pass(0.1);
    r.receive({.robot = "anna"}, 0, -3600 * kSecond);
    EXPECT_EQ(r.condition("anna"), Condition::moving);
    // The clock runs 1 % slow, so it falls behind by 18 s in half an hour.
    Receiver slow;
    for (int i = 0; i < 1800; ++i) {
        slow.receive({.robot = "anna"}, 0, -i * kSecond / 100);
        slow.pass(1);
    }
    EXPECT_EQ(slow.condition("anna"), Condition::moving);
}

TEST(FleetConditions, RobotsAreNotSilentWhileTheBrokerIsAway) {
    Receiver r;
    r.receive({.robot = "anna"});
    r.pass_blind(3600);
    r.pass(1);
    EXPECT_EQ(r.condition("anna"), Condition::moving);
    r.pass(4.5);
    EXPECT_EQ(r.condition("anna"), Condition::silent);
}

TEST(FleetConditions, AnEmptyConnectionMessageRemovesTheRobot) {
    Receiver r;
    r.receive({.robot = "anna"});
    r.receive({.robot = "bert"});
    r.fleet.take(connection_topic("anna"), "", r.now());
    r.fleet.take(connection_topic("nobody"), "", r.now());
    EXPECT_EQ(r.fleet.robots(r.now()).size(), 1U);
    EXPECT_EQ(r.fleet.counts().messages, 2);
    EXPECT_EQ(r.fleet.bad(), 0);
}

/// Returns the changes in the robots' conditions as text, such as "anna lost (moving)".
std::vector<std::string> words(AlertWatch& watch, const Receiver& r) {
    std::vector<std::string> words;
    for (const auto& alert : watch.changes(r.fleet.robots(r.now()), r.now())) {
        words.push_back(fmt::format("{} {} ({})", alert.robot, alert.condition, alert.previous));
    }
    return words;
}

TEST(FleetAlerts, ReportEachChangeOnce) {
    Receiver r;
    AlertWatch watch;
    r.receive({.robot = "anna"});
    r.receive({.robot = "bert", .is_localized = false});
    EXPECT_THAT(words(watch, r), ElementsAre());
    r.pass(1.1);
    r.receive({.robot = "anna", .state = "stationary"});
    r.receive({.robot = "bert", .is_localized = false});
    EXPECT_THAT(words(watch, r), ElementsAre("bert lost ()"));
    EXPECT_THAT(words(watch, r), ElementsAre());
    r.pass(5.1);
    EXPECT_THAT(words(watch, r), ElementsAre("anna silent (still)", "bert silent (lost)"));
    r.receive({.robot = "anna"});
    r.connect("bert", "OFFLINE");
    EXPECT_THAT(words(watch, r), ElementsAre("anna moving (silent)", "bert gone (silent)"));
    r.fleet.take(connection_topic("bert"), "", r.now());
    EXPECT_THAT(words(watch, r), ElementsAre("bert removed (gone)"));
    EXPECT_THAT(words(watch, r), ElementsAre());
}

TEST(FleetAlerts, BriefLossesAndRobotsThatLeftEarlierAreNotReported) {
    Receiver r;
    AlertWatch watch;
    r.receive({.robot = "anna"});
    r.connect("old", "OFFLINE", 7200 * kSecond);
    EXPECT_THAT(words(watch, r), ElementsAre());
    for (int i = 0; i < 20; ++i) {
        r.receive({.robot = "anna", .is_localized = false});
        r.pass(0.9);
        EXPECT_THAT(words(watch, r), ElementsAre());
        r.receive({.robot = "anna"});
        EXPECT_THAT(words(watch, r), ElementsAre());
    }
}

TEST(NaturalOrder, ComparesNumbersByValue) {
    const cli::NaturalOrder less;
    const std::vector<std::string> sorted = {
        "",       "anna",     "anna2",   "anna10",    "robot",      "robot1a",
        "robot2", "robot02b", "robot10", "robot10-2", "robot10-11", "robot18446744073709551617",
        "robots"};
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        for (std::size_t j = 0; j < sorted.size(); ++j)
            EXPECT_EQ(less(sorted[i], sorted[j]), i < j) << sorted[i] << " " << sorted[j];
    }
    EXPECT_NE(less("a01", "a1"), less("a1", "a01"));  // different names never compare equal
}

std::vector<std::string> page_of(cli::FleetPage& page, const Receiver& r,
                                 const cli::FleetMap& map = {}) {
    return page.lines(r.fleet, r.fleet.robots(r.now()), map, cli::Delivery::all, {80, 24});
}

TEST(FleetPage, FiveHundredRobotsInTwentyFourRows) {
    Receiver r;
    for (int i = 0; i < 500; ++i) {
        Message message{.robot = fmt::format("robot{}", i)};
        if (i == 333) message.is_localized = false;
        r.receive(message);
    }
    r.connect("robot444", "CONNECTIONBROKEN");
    r.connect("robot1", "OFFLINE");
    cli::FleetPage page;
    auto lines = page_of(page, r);
    ASSERT_EQ(lines.size(), 24U);
    EXPECT_THAT(lines[1],
                testing::MatchesRegex("robot444 +silent +0 +0.0 +0.0 +-  connection broke, table"));
    EXPECT_THAT(lines[2], StartsWith("robot333       lost "));
    EXPECT_THAT(lines[3], testing::MatchesRegex("robot0 +moving +0 +0.0 +0.0 +500  table"));
    EXPECT_THAT(lines[4], StartsWith("robot2 "));
    EXPECT_THAT(lines[21], HasSubstr("500 robots: 497 moving, 0 still, 1 lost, 1 silent, 1 gone"));
    EXPECT_THAT(lines[23], StartsWith("1-20 of 500, attention first"));
    page.take(cli::Key::page_down);
    EXPECT_THAT(page_of(page, r)[23], StartsWith("21-40 of 500"));
    page.take(cli::Key::end);
    lines = page_of(page, r);
    EXPECT_THAT(lines[20], StartsWith("robot1 "));  // this robot is gone
    EXPECT_THAT(lines[23], StartsWith("481-500 of 500"));
    page.take(cli::Key::up);
    EXPECT_THAT(page_of(page, r)[23], StartsWith("480-499 of 500"));
    page.take(cli::Key::order);
    lines = page_of(page, r);
    for (int i = 0; i < 20; ++i)
        EXPECT_THAT(lines[static_cast<std::size_t>(i) + 1], StartsWith(fmt::format("robot{} ", i)));
    lines.erase(lines.begin() + 22);  // the line with the message counts is longer than 80 columns
    for (const std::string& line : lines)
        EXPECT_LE(line.size(), 80U) << line;
}

TEST(FleetPage, MarksPlacesThatTheSheetFileDoesNotKnow) {
    Receiver r;
    r.receive({.robot = "anna", .sheet = "left"});
    r.receive({.robot = "bert", .map = "other", .sheet = "left"});
    r.receive({.robot = "carl", .sheet = "new"});
    cli::FleetMap map;
    map.id = "table";
    map.names = {"left", "right"};
    cli::FleetPage page;
    const auto lines = page_of(page, r, map);
    EXPECT_THAT(lines[1], testing::AllOf(StartsWith("bert "), testing::EndsWith("other/left?")));
    EXPECT_THAT(lines[2], testing::AllOf(StartsWith("carl "), testing::EndsWith("table/new?")));
    EXPECT_THAT(lines[3], testing::AllOf(StartsWith("anna "), testing::EndsWith("table/left")));
    EXPECT_THAT(lines[21], HasSubstr("2 on maps or sheets not in table (?)"));
    const auto drawing = cli::drawing_of(r.fleet, "table", map, r.now());
    EXPECT_THAT(drawing.notes, ElementsAre("bert: moving on other/left?, x 0.000 m, y 0.000 m"));
}

TEST(FleetDrawing, ShowsTheVisitedSheets) {
    Receiver r;
    r.receive({.robot = "anna", .x_m = 0.15, .y_m = 0.05});
    cli::FleetMap map;
    map.id = "table";
    for (int i = 0; i < 50; ++i) {
        const double x = 100.0 * i;
        map.outlines.push_back(
            {fmt::format("sheet{}", i), {{{x, 0}, {x + 90, 0}, {x + 90, 90}, {x, 90}}}});
    }
    const auto drawing = cli::drawing_of(r.fleet, "table", map, r.now());
    ASSERT_EQ(drawing.sheets.size(), 1U);
    EXPECT_EQ(drawing.sheets[0].name, "sheet1");
    EXPECT_THAT(drawing.notes, ElementsAre("1 of 50 sheets, those visited"));
}

}  // namespace
}  // namespace dotpose::test
