// Tests `dotpose fleet --store` and `dotpose fleet history` with a mosquitto broker and with
// databases.
#include <string>
#include <thread>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../drive.hpp"
#include "../paths.hpp"
#include "mqtt_fixture.hpp"
#include "postgres.hpp"
#include "robot_message.hpp"
#include "watched_fleet.hpp"

namespace dotpose::test {
namespace {

using publish::MqttPublisher;
using testing::HasSubstr;
using testing::StartsWith;

class FleetStore : public Mqtt {
  protected:
    void publish(const Broker& broker, int robots, int states, int first = 0) {
        const ShellOutcome outcome = run_shell(fmt::format(
            "'{}' --port {} --robots {} --hz 20 --seconds {} --first {}",
            test::built("dotpose_fleet_load"), broker.port(), robots, states / 20.0, first));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    }
    /// Publishes the messages with QoS 1, and waits until a fleet has logged them.
    void publish_messages(const Broker& broker, const std::vector<Message>& messages) {
        publish::MqttOptions mqtt = options(broker);
        mqtt.qos = 1;
        MqttPublisher sender(mqtt);
        for (const Message& message : messages) {
            sender.publish(state_topic(message.robot), message.json());
            EXPECT_TRUE(sender.flush(20s));
        }
        wait_until([&] {
            const std::string log = file("log.csv");
            return std::ranges::count(log, '\n') == std::ssize(messages) + 1;
        });
    }
    std::int64_t lines() const { return std::ranges::count(output_, '\n'); }
};

TEST_F(FleetStore, HistoryOfAFile) {
    const Broker broker(directory_);
    save_drive_sheets(directory_ / "table.json");
    {
        WatchedFleet fleet(directory_,
                           "--qos 1 --store fleet.db --log log.csv --mqtt " + broker.url());
        std::vector<Message> messages;
        for (int i = 0; i < 40; ++i) {
            messages.push_back({.robot = "anna",
                                .header_id = i,
                                .time = time_now(),
                                .x_m = 0.001 * i,
                                .y_m = -0.01,
                                .sheet = "left"});
            std::this_thread::sleep_for(1ms);
        }
        messages.push_back({.robot = "anna",
                            .header_id = 40,
                            .time = time_now(),
                            .state = "lost",
                            .is_localized = false,
                            .reason = "no_grid"});
        messages.push_back({.robot = "'; DROP TABLE states; --", .time = time_now()});
        // The clock of this robot is a year behind. The database must contain the time of arrival
        // instead.
        messages.push_back({.robot = "old", .time = "2025-11-24T16:00:00Z"});
        publish_messages(broker, messages);
        fleet.table();
        EXPECT_THAT(file("news"), HasSubstr("43 states stored, 0 dropped"));
    }
    ASSERT_EQ(run("fleet history --store fleet.db --format csv"), 0) << errors_;
    EXPECT_EQ(lines(), 4);
    EXPECT_THAT(output_, StartsWith("robot,first,last\n'; DROP TABLE states; --,"));
    EXPECT_THAT(output_, testing::Not(HasSubstr("\nold,2025")));

    ASSERT_EQ(run("fleet history --store fleet.db --robot anna --format csv"), 0) << errors_;
    EXPECT_EQ(lines(), 42);
    EXPECT_THAT(output_, StartsWith("robot,time,state,reason,map,sheet,number,latency_ms,x_mm,y_mm,"
                                    "theta_deg,deviation_mm,vx_mm_s,vy_mm_s,turn_deg_s\nanna,20"));
    EXPECT_THAT(output_, HasSubstr("Z,moving,,table,left,39,"));
    EXPECT_THAT(output_, testing::ContainsRegex(
                             ",39.000000,-10.000000,0.000000,0.001000,0.000,500.000,0.000\n"));
    EXPECT_THAT(output_, testing::ContainsRegex("Z,lost,no_grid,table,left,40,[-0-9.]+,,,,,,,\n$"));
    ASSERT_EQ(run("fleet history --store fleet.db --robot anna"), 0);
    EXPECT_THAT(output_, StartsWith("{\"robot\":\"anna\",\"time\":\"20"));

    ASSERT_EQ(run("fleet history --store fleet.db --robot anna --sheets table.json --draw a.svg"),
              0)
        << errors_;
    EXPECT_EQ(output_, "");
    EXPECT_THAT(file("a.svg"), HasSubstr("anna on table"));
    EXPECT_THAT(file("a.svg"), HasSubstr(R"(class="track")"));
    const std::string day = time_now().substr(0, 10);
    EXPECT_EQ(run("fleet history --store fleet.db --robot anna --to " + day), 1);
    EXPECT_THAT(errors_,
                HasSubstr("there are no states of anna in this time: its states are from"));
    EXPECT_EQ(run("fleet history --store fleet.db --robot anna --from " + day), 0);
    EXPECT_EQ(lines(), 41);
}

TEST_F(FleetStore, RefusesWhatItCannotRead) {
    EXPECT_EQ(run("fleet history --robot anna"), 2);
    EXPECT_EQ(run("fleet history --store none.db --robot anna"), 1);
    EXPECT_THAT(errors_, HasSubstr("none.db: unable to open database file"));
    EXPECT_EQ(run("fleet history --store none.db --robot anna --from yesterday"), 2);
    EXPECT_THAT(errors_, HasSubstr("'yesterday' is not a time such as 2026-11-28"));
    EXPECT_EQ(run("fleet history --store none.db --robot a --from 2026-02-02 --to 2026-02-01"), 2);
    EXPECT_EQ(run("fleet history --store none.db --draw a.svg"), 2);
    const std::string nowhere = fmt::format(" --mqtt mqtt://127.0.0.1:{}", free_port());
    EXPECT_EQ(run("fleet --store . --seconds 1" + nowhere), 1);
    EXPECT_EQ(run("fleet --store 'postgresql://[' --seconds 1" + nowhere), 2);
}

TEST_F(FleetStore, ACrashOfTheDatabaseLosesNothing) {
    constexpr int kRobots = 50;
    constexpr int kStates = 300;  // 15 s
    const Broker broker(directory_);
    Postgres postgres;
    WatchedFleet fleet(directory_, "--qos 1 --log log.csv --store '" + postgres.url() +
                                       "' --mqtt " + broker.url());
    std::thread robots([&] { publish(broker, kRobots, kStates); });
    const auto stored = [&] {
        return std::stoi(postgres.query("SELECT count(*) FROM dotpose.states"));
    };
    wait_until([&] { return stored() > 0; });
    postgres.crash();
    wait_until([&] {
        return file("news").starts_with(
            "dotpose: cannot store states in postgresql://127.0.0.1/fleet: ");
    });
    postgres.start();
    robots.join();
    wait_until([&] { return stored() == kRobots * kStates; }, 60s);
    EXPECT_EQ(
        postgres.query("SELECT count(*), min(n), max(n) FROM (SELECT count(DISTINCT number) AS "
                       "n FROM dotpose.states GROUP BY robot) AS each"),
        "50|300|300\n");
    fleet.table();
    EXPECT_THAT(file("news"), HasSubstr("answers again"));
    EXPECT_THAT(file("news"), HasSubstr("15000 states stored, 0 dropped"));
    ASSERT_EQ(run("fleet history --robot robot7 --format csv --store '" + postgres.url() + "'"), 0);
    EXPECT_EQ(lines(), kStates + 1);
    EXPECT_EQ(
        postgres.query("SELECT count(*) FROM dotpose.history WHERE robot = 'robot7' AND time > "
                       "now() - interval '1 hour' AND map = 'table'"),
        "300\n");
}

TEST_F(FleetStore, ADatabaseThatIsNeverReachedIsAFailure) {
    const Broker broker(directory_);
    const std::string nowhere = fmt::format("postgresql://x:secret@127.0.0.1:{}/y", free_port());
    WatchedFleet fleet(directory_, "--log log.csv --store-buffer 2 --store '" + nowhere +
                                       "' --mqtt " + broker.url());
    publish_messages(broker, {{.robot = "anna", .header_id = 1, .time = time_now()},
                              {.robot = "anna", .header_id = 2, .time = time_now()},
                              {.robot = "anna", .header_id = 3, .time = time_now()}});
    fleet.table();
    const std::string news = file("news");
    EXPECT_THAT(news, HasSubstr("cannot store states in postgresql://127.0.0.1/y: "));
    EXPECT_THAT(news, HasSubstr("more than 2 states wait; the oldest are dropped"));
    EXPECT_THAT(news, HasSubstr("3 states were not stored"));
    EXPECT_THAT(news, testing::Not(HasSubstr("secret")));
}

}  // namespace
}  // namespace dotpose::test
