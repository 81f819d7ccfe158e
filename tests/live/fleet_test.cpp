// Tests `dotpose fleet` with states that are published to a mosquitto broker.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../drive.hpp"
#include "dotpose/tools/image_file.hpp"
#include "mqtt_fixture.hpp"
#include "robot_message.hpp"
#include "watched_fleet.hpp"

namespace dotpose::test {
namespace {

using publish::MqttOptions;
using publish::MqttPublisher;
using testing::HasSubstr;

using Fleet = Mqtt;

TEST_F(Fleet, SeesAWatchedRobot) {
    const Broker broker(directory_);
    const DriveCamera camera(188, 120);
    const Drive drive;
    for (int i = 0; i < 20; ++i) {
        write_pgm(directory_ / ("f" + std::to_string(100 + i) + ".pgm"),
                  camera.frame(drive, 240 + i).view());
    }
    save_drive_sheets(directory_ / "table.json");
    WatchedFleet fleet(directory_, "--sheets table.json --mqtt " + broker.url());
    EXPECT_EQ(
        run("watch 'f*.pgm' --fps 200 --sheets table.json --robot anna --mqtt " + broker.url()), 0);
    EXPECT_THAT(errors_, HasSubstr("20 states published, 0 dropped"));
    std::this_thread::sleep_for(500ms);
    const std::string table = fleet.table();
    EXPECT_THAT(table, HasSubstr("\nanna             gone  "));
    EXPECT_THAT(table, testing::ContainsRegex(" 20 +0  disconnected, table/left\n"));
    EXPECT_THAT(table, HasSubstr("1 robots, 20 states, 0 bad"));
    EXPECT_THAT(file("fleet.svg"), HasSubstr("anna (gone)"));
    EXPECT_THAT(file("fleet.svg"), HasSubstr(">left<"));
}

TEST_F(Fleet, TwoHundredRobots) {
    constexpr int kRobots = 200;
    constexpr int kStates = 50;
    const Broker broker(directory_);
    WatchedFleet fleet(directory_,
                       "--qos 1 --silent-after 600 --gone-after 600 --mqtt " + broker.url());
    std::vector<std::unique_ptr<MqttPublisher>> robots;
    for (int i = 0; i < kRobots; ++i)
        robots.push_back(std::make_unique<MqttPublisher>(options(broker)));
    const auto begun = std::chrono::steady_clock::now();
    for (int n = 0; n < kStates; ++n) {
        for (int i = 0; i < kRobots; ++i) {
            const std::string name = fmt::format("robot{}", i);
            const Message message{name,    n,       time_now(), "moving", n + 1 < kStates,
                                  0.1 * i, 0.01 * n};
            robots[static_cast<std::size_t>(i)]->publish(state_topic(name), message.json());
        }
        std::this_thread::sleep_until(begun + (n + 1) * 20ms);
    }
    for (const auto& robot : robots)
        EXPECT_TRUE(robot->flush(20s));
    // Returns true if the map marks every robot as lost.
    const auto are_all_lost = [&] {
        const std::string map = file("fleet.svg");
        int lost = 0;
        for (std::size_t at = 0; (at = map.find("(lost)", at)) != std::string::npos; ++at)
            ++lost;
        return lost == kRobots;
    };
    wait_until(are_all_lost, 60s);
    const std::string table = fleet.table();
    EXPECT_THAT(
        table,
        HasSubstr(
            "200 robots, 10000 states, 0 bad, 0 missed, 0 late, 0 repeated, latency median "));
    EXPECT_THAT(table, testing::Not(testing::ContainsRegex(" 50 +[1-9][0-9]*  ")));
    std::printf("%s", table.substr(table.rfind("200 robots")).c_str());
}

TEST_F(Fleet, TopicsTellWhoARobotIsAndTextsDoNotActOnTheTerminal) {
    const Broker broker(directory_);
    WatchedFleet fleet(directory_, "--mqtt " + broker.url());
    MqttPublisher sender(options(broker));
    const std::string time = "2026-11-24T16:00:00.000000Z";
    sender.publish(state_topic("anna"), Message{"bert", 1, time}.json());
    sender.publish(state_topic("\xe2\x80\xae"
                               "red"),
                   Message{"\x1b[2J", 1, time, "\x1b]0;OWNED\x07\nroot moving"}.json());
    for (const char* bad : {"2026-11-24T16:00:nanZ", "2026-11-24T16:00:00", "", "now"})
        sender.publish(state_topic("carl"), Message{"carl", 1, bad}.json());
    sender.publish(state_topic("\x1b[31mred"), "{}");  // the publisher rejects this topic
    sender.publish(state_topic("dora"), std::string(1'000'000, '['));
    EXPECT_TRUE(sender.flush(20s));
    EXPECT_EQ(sender.dropped(), 1);
    std::this_thread::sleep_for(500ms);
    const std::string table = fleet.table();
    EXPECT_THAT(table, HasSubstr("\nanna  "));
    EXPECT_THAT(table, testing::Not(HasSubstr("bert")));
    EXPECT_THAT(table, HasSubstr("2 robots, 2 states, 5 bad"));
    EXPECT_EQ(std::ranges::count(table, '\n'), 5) << table;
    EXPECT_EQ(table.find_first_of("\x1b\x07"), std::string::npos);
}

TEST_F(Fleet, ASenderWhoseClockWasSetBackIsFollowed) {
    const Broker broker(directory_);
    WatchedFleet fleet(directory_, "--mqtt " + broker.url());
    MqttOptions mqtt = options(broker);
    mqtt.qos = 1;
    MqttPublisher sender(mqtt);
    const auto send = [&](const char* robot, int header_id, const char* time) {
        const Message message{robot, header_id, time, "moving", true, 0.1 * header_id};
        sender.publish(state_topic(robot), message.json());
        EXPECT_TRUE(sender.flush(20s));
    };
    // The clock was set back. The message numbers continue, so the sender was not restarted.
    send("anna", 7, "2026-11-24T16:00:00Z");
    send("anna", 8, "2026-11-24T15:00:00Z");
    // The sender was restarted and its clock was set back, so its message numbers restart at 0.
    send("bert", 700, "2026-11-24T16:00:00Z");
    for (int i = 0; i < 6; ++i)
        send("bert", i, fmt::format("2026-11-24T15:00:0{}Z", i).c_str());
    // A single late message must not replace the newest state.
    send("carl", 9, "2026-11-24T16:00:01Z");
    send("carl", 8, "2026-11-24T16:00:00Z");
    // Number 3 is missing, and number 2 is repeated.
    for (const int number : {1, 2, 2, 4})
        send("dora", number, fmt::format("2026-11-24T16:00:0{}Z", number).c_str());
    std::this_thread::sleep_for(500ms);
    const std::string table = fleet.table();
    EXPECT_THAT(table, HasSubstr("4 robots, 15 states, 0 bad, 1 missed, 5 late, 1 repeated"));
    EXPECT_THAT(table, testing::ContainsRegex("\ndora .* 4 +1  "));
    EXPECT_THAT(table, testing::ContainsRegex("\nanna +[a-z]+ +[0-9.]+ +800.000 "));
    EXPECT_THAT(table, testing::ContainsRegex("\nbert +[a-z]+ +[0-9.]+ +500.000 "));
    EXPECT_THAT(table, testing::ContainsRegex("\ncarl +[a-z]+ +[0-9.]+ +900.000 "));
}

TEST_F(Fleet, SubscribesWithTls) {
    constexpr int kStates = 200;
    const Broker broker(directory_, {}, true);
    WatchedFleet fleet(directory_,
                       "--qos 1 --mqtt-ca " + broker.certificate() + " --mqtt " + broker.url());
    MqttOptions mqtt = options(broker);
    mqtt.ca_file = broker.certificate();
    mqtt.qos = 1;
    mqtt.queue = kStates;
    MqttPublisher sender(mqtt);
    for (int i = 0; i < kStates; ++i)
        sender.publish(state_topic("anna"), Message{"anna", i, time_now()}.json());
    EXPECT_TRUE(sender.flush(20s));
    std::this_thread::sleep_for(500ms);
    // The publisher sends the newest states in its queue first, so some older states arrive late.
    EXPECT_THAT(fleet.table(), HasSubstr("1 robots, 200 states, 0 bad, 0 missed, "));
}

TEST_F(Fleet, InventedNamesFillNoMemory) {
    constexpr int kNames = 12'000;
    const Broker broker(directory_);
    WatchedFleet fleet(directory_, "--qos 1 --log states.csv --mqtt " + broker.url());
    MqttOptions mqtt = options(broker);
    mqtt.qos = 1;
    mqtt.queue = kNames;
    MqttPublisher sender(mqtt);
    for (int i = 0; i < kNames; ++i) {
        sender.publish(state_topic(fmt::format("invented{}", i)),
                       Message{"x", 1, "2026-11-24T16:00:00Z"}.json());
    }
    EXPECT_TRUE(sender.flush(60s));
    constexpr int kMaxRobots = 10'000;
    wait_until(
        [this] {
            const std::string log = read_file(directory_ / "states.csv");
            return std::ranges::count(log, '\n') > kMaxRobots;  // the first line is the header
        },
        60s);
    const std::string table = fleet.table();
    const std::size_t last_line = table.rfind('\n', table.size() - 2) + 1;
    // On a busy machine, the last states may still be in transit.
    EXPECT_THAT(table.substr(last_line),
                testing::AllOf(testing::StartsWith("10000 robots, "), HasSubstr(" states, 0 bad")));
}

TEST_F(Fleet, ShowsARobotThatLeftBeforeItCame) {
    const Broker broker(directory_);
    write_pgm(directory_ / "f.pgm", DriveCamera(188, 120).frame(Drive(), 240).view());
    ASSERT_EQ(run("watch f.pgm --robot anna --mqtt " + broker.url()), 0) << errors_;
    WatchedFleet fleet(directory_, "--mqtt " + broker.url());
    std::this_thread::sleep_for(500ms);
    EXPECT_THAT(fleet.table(), HasSubstr("\nanna             gone  "));
}

TEST_F(Fleet, ABrokerThatIsNeverReachedIsAFailure) {
    const std::string nowhere = fmt::format(" --mqtt mqtt://127.0.0.1:{}", free_port());
    const std::string reason = "was never reached: Connection refused";
    EXPECT_EQ(run("fleet --seconds 0.2 --log log.csv" + nowhere), 1);
    EXPECT_THAT(errors_, HasSubstr(reason));
    EXPECT_THAT(output_, HasSubstr("0 robots"));
    EXPECT_THAT(file("log.csv"), HasSubstr("robot,state"));
    write_pgm(directory_ / "f.pgm", DriveCamera(188, 120).frame(Drive(), 240).view());
    EXPECT_EQ(run("watch f.pgm --draw path.svg" + nowhere), 1);
    EXPECT_THAT(errors_, HasSubstr(reason));
    EXPECT_THAT(output_, HasSubstr("\"status\":\"ok\""));
    EXPECT_TRUE(fs::exists(directory_ / "path.svg"));
}

TEST_F(Fleet, NeedsABroker) {
    EXPECT_EQ(run("fleet"), 2);
    EXPECT_EQ(run("fleet --mqtt nonsense"), 2);
    EXPECT_THAT(errors_, HasSubstr("'nonsense' is not mqtt://HOST or mqtts://HOST"));
    EXPECT_EQ(run("watch nowhere.mp4 --robot a/b"), 2);
    EXPECT_THAT(errors_, HasSubstr("must not contain / + #"));
    EXPECT_EQ(run("watch nowhere.mp4 --robot " + std::string(129, 'a')), 2);
    EXPECT_THAT(errors_, HasSubstr("must have 1 to 128 bytes"));
}

}  // namespace
}  // namespace dotpose::test
