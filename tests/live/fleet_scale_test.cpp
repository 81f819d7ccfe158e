// Tests `dotpose fleet` with many robots, shared subscriptions, bridged brokers and interruptions.
#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../drive.hpp"
#include "../paths.hpp"
#include "mqtt_fixture.hpp"
#include "watched_fleet.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;

/// A state in a fleet's log: the name of the robot, and the number of the message.
using Logged = std::pair<std::string, int>;

class FleetScale : public Mqtt {
  protected:
    fs::path folder(const std::string& name) {
        fs::create_directory(directory_ / name);
        return directory_ / name;
    }

    /// Publishes `states` states of each of `robots` robots. Each robot publishes 20 states per
    /// second. Returns when the broker has received all states.
    void publish(const Broker& broker, int robots, int states, int first = 0) {
        const ShellOutcome outcome = run_shell(fmt::format(
            "'{}' --port {} --robots {} --hz 20 --seconds {} --first {}",
            test::built("dotpose_fleet_load"), broker.port(), robots, states / 20.0, first));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    }

    /// Returns the states in the logs of several fleets. Each state occurs as many times as it was
    /// logged.
    std::multiset<Logged> logged(const std::vector<fs::path>& folders) {
        std::multiset<Logged> states;
        for (const fs::path& folder : folders) {
            std::istringstream lines(read_file(folder / "log.csv"));
            std::string line;
            for (std::getline(lines, line); std::getline(lines, line);) {
                std::array<std::string, 4> cells;
                std::istringstream row(line);
                for (std::string& cell : cells)
                    std::getline(row, cell, ',');
                if (!row.eof()) states.emplace(cells[0], std::stoi(cells[3]));
            }
        }
        return states;
    }

    void wait_for_states(const std::vector<fs::path>& folders, std::size_t count) {
        wait_until([&] { return logged(folders).size() >= count; }, 60s);
    }

    /// Returns states 0 to `states` - 1 of robots 0 to `robots` - 1, once each.
    static std::multiset<Logged> states_of(int robots, int states) {
        std::multiset<Logged> all;
        for (int robot = 0; robot < robots; ++robot) {
            for (int number = 0; number < states; ++number)
                all.emplace(fmt::format("robot{}", robot), number);
        }
        return all;
    }
};

TEST_F(FleetScale, TwoHundredRobotsAtTwentyHertzLoseNothing) {
    constexpr int kRobots = 200;
    constexpr int kStates = 100;
    const Broker broker(directory_);
    WatchedFleet fleet(directory_, "--qos 1 --log log.csv --mqtt " + broker.url());
    publish(broker, kRobots, kStates);
    wait_for_states({directory_}, std::size_t{kRobots} * kStates);
    const std::string table = fleet.table();
    EXPECT_THAT(table, HasSubstr("200 robots, 20000 states, 0 bad, 0 missed, 0 late, 0 repeated"));
    std::istringstream lines(table);
    std::string line;
    int complete = 0;
    while (std::getline(lines, line)) {
        complete += line.starts_with("robot") &&
                    testing::Matches(testing::ContainsRegex(" 100 +0  "))(line);
    }
    EXPECT_EQ(complete, kRobots);
    std::printf("%s", table.substr(table.rfind("200 robots")).c_str());
}

TEST_F(FleetScale, AGroupSharesTheStates) {
    const Broker broker(directory_);
    const std::vector<fs::path> folders = {folder("a"), folder("b")};
    const std::string arguments = "--qos 1 --share group --log log.csv --mqtt " + broker.url();
    WatchedFleet a(folders[0], arguments);
    WatchedFleet b(folders[1], arguments);
    // The broker sends each state to one of the two members, in turn. Because the number of robots
    // is odd, each member receives every other state of each robot.
    publish(broker, 51, 40);
    wait_for_states(folders, 51 * 40);
    for (WatchedFleet* fleet : {&a, &b}) {
        // The states that the other member received must not be reported as missing.
        EXPECT_THAT(fleet->table(),
                    testing::ContainsRegex("\n51 robots, [0-9]+ states, 0 bad, 0 repe"));
    }
    EXPECT_EQ(logged(folders), states_of(51, 40));
    EXPECT_GT(logged({folders[0]}).size(), 500U);
    EXPECT_GT(logged({folders[1]}).size(), 500U);
}

TEST_F(FleetScale, ShardsDivideTheRobots) {
    const Broker broker(directory_);
    const std::vector<fs::path> folders = {folder("a"), folder("b")};
    const std::string arguments = " --qos 1 --log log.csv --mqtt " + broker.url();
    WatchedFleet a(folders[0], "--shard 1/2" + arguments);
    WatchedFleet b(folders[1], "--shard 2/2" + arguments);
    publish(broker, 50, 20);
    wait_for_states(folders, 50 * 20);
    EXPECT_THAT(a.table(), HasSubstr(" states, 0 bad, 0 missed, 0 late, 0 repeated"));
    EXPECT_THAT(b.table(), HasSubstr(" states, 0 bad, 0 missed, 0 late, 0 repeated"));
    EXPECT_EQ(logged(folders), states_of(50, 20));
    std::set<std::string> of_a;
    for (const Logged& state : logged({folders[0]}))
        of_a.insert(state.first);
    EXPECT_EQ(logged({folders[0]}).size(), of_a.size() * 20);
    EXPECT_GT(of_a.size(), 15U);
    EXPECT_LT(of_a.size(), 35U);
}

TEST_F(FleetScale, BridgedBrokersPassOnEachStateOnce) {
    const std::vector<fs::path> folders = {folder("east"), folder("west")};
    const Broker west(folders[1]);
    const Broker east(folders[0], {}, false,
                      fmt::format("connection west\naddress 127.0.0.1:{}\n"
                                  "topic uagv/v2/dotpose/# both 1\ncleansession false\n"
                                  "restart_timeout 1\n",
                                  west.port()));
    WatchedFleet in_east(folders[0], "--qos 1 --log log.csv --mqtt " + east.url());
    WatchedFleet in_west(folders[1], "--qos 1 --log log.csv --mqtt " + west.url());
    // The bridge is ready when it has forwarded a state.
    wait_until([&] {
        publish(west, 1, 1, 1000);
        std::this_thread::sleep_for(200ms);
        return !logged({folders[0]}).empty();
    });
    const auto before = logged({folders[0]}).size();
    std::thread eastern([&] { publish(east, 50, 60); });
    publish(west, 50, 60, 50);
    eastern.join();
    for (const fs::path& folder : folders) {
        wait_until([&] { return logged({folder}).size() >= before + 100 * 60; }, 60s);
    }
    std::this_thread::sleep_for(500ms);  // repeated states would arrive during this time
    for (WatchedFleet* fleet : {&in_east, &in_west}) {
        const std::string table = fleet->table();
        EXPECT_THAT(table, HasSubstr("101 robots, "));
        EXPECT_THAT(table, HasSubstr(" 0 missed, 0 late, 0 repeated"));
    }
    for (const fs::path& folder : folders) {
        std::multiset<Logged> states = logged({folder});
        states.erase({"robot1000", 0});
        EXPECT_EQ(states, states_of(100, 60)) << folder;
    }
}

TEST_F(FleetScale, TimeoutSendsItsSignalTwice) {
    const Broker broker(directory_);
    WatchedFleet fleet(directory_, "--log log.csv --mqtt " + broker.url());
    publish(broker, 3, 20);
    wait_for_states({directory_}, 3 * 20);
    fs::remove(directory_ / "fleet.svg");
    fleet.signal(SIGTERM);
    std::this_thread::sleep_for(5ms);
    fleet.signal(SIGTERM);
    EXPECT_THAT(fleet.table(), HasSubstr("\n3 robots, 60 states, "));
    EXPECT_THAT(file("fleet.svg"), HasSubstr("robot2"));
    EXPECT_EQ(logged({directory_}), states_of(3, 20));
}

TEST_F(FleetScale, ARobotThatVanishesIsLost) {
    const Broker broker(directory_);
    const DriveCamera camera(188, 120);
    const Drive drive;
    std::ofstream frames(directory_ / "frames", std::ios::binary);
    for (int i = 0; i < 20; ++i) {
        const GreyImage image = camera.frame(drive, 240 + i);
        frames.write(reinterpret_cast<const char*>(image.pixels.data()),
                     static_cast<std::streamsize>(image.pixels.size()));
    }
    frames.close();
    save_drive_sheets(directory_ / "table.json");
    WatchedFleet fleet(directory_, "--qos 1 --log log.csv --mqtt " + broker.url());
    std::thread robot([&] {
        run_shell("cd '" + directory_.string() +
                  "' && mkfifo camera && { { cat frames; exec sleep 60; } > camera & "
                  "echo $! > sender; '" +
                  test::tool_path() +
                  "' watch - --size 188x120 --fps 200 "
                  "--sheets table.json --robot anna --qos 1 --mqtt " +
                  broker.url() + " < camera > lines 2> told & echo $! > robot; wait; }");
    });
    wait_for_states({directory_}, 20);
    kill(std::stoi(file("robot")), SIGKILL);
    kill(std::stoi(file("sender")), SIGTERM);
    robot.join();
    std::this_thread::sleep_for(500ms);
    const std::string table = fleet.table();
    EXPECT_THAT(table, HasSubstr("\nanna             silent  "));
    EXPECT_THAT(table, HasSubstr("1 robots, 20 states, 0 bad, 0 missed, 0 late, 0 repeated"));
    EXPECT_THAT(file("fleet.svg"), HasSubstr("anna (silent)"));
}

TEST_F(FleetScale, RefusesHalvesThatAreNone) {
    const std::string fleet = "fleet --mqtt mqtt://127.0.0.1:1 --seconds 1 ";
    for (const char* bad : {"--shard 0/2", "--shard 1", "--share a/b", "--share a --shard 1/2"})
        EXPECT_EQ(run(fleet + bad), 2) << bad;
}

}  // namespace
}  // namespace dotpose::test
