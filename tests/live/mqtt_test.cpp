// Publishing to a real broker: what arrives, what is dropped, and what happens when it goes away.
#include "publish/mqtt.hpp"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../blackbox/tool_command.hpp"
#include "../drive.hpp"
#include "broker.hpp"
#include "dotpose/image_file.hpp"

namespace dotpose::test {
namespace {

using namespace std::chrono_literals;
using publish::MqttOptions;
using publish::MqttPublisher;
using publish::MqttSubscriber;
using testing::HasSubstr;

void wait_until(const std::function<bool()>& condition, std::chrono::milliseconds most = 20s) {
    const auto end = std::chrono::steady_clock::now() + most;
    while (!condition() && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(5ms);
    ASSERT_TRUE(condition());
}

/// What was told, by any thread.
class News {
  public:
    std::function<void(const std::string&)> listener() {
        return [this](const std::string& text) {
            const std::lock_guard lock(mutex_);
            text_ += text + "\n";
        };
    }
    std::string text() const {
        const std::lock_guard lock(mutex_);
        return text_;
    }

  private:
    mutable std::mutex mutex_;
    std::string text_;
};

class Mqtt : public ToolCommand {
  protected:
    MqttOptions options(const Broker& broker) {
        MqttOptions options;
        publish::parse_url(broker.url(), options);
        options.tell = news_.listener();
        return options;
    }
    std::string shell(const std::string& command) {
        EXPECT_EQ(
            std::system(("cd '" + directory_.string() + "' && { " + command + "; } > out").c_str()),
            0);
        return file("out");
    }
    News news_;
};

TEST_F(Mqtt, ReadsUrls) {
    MqttOptions options;
    publish::parse_url("mqtt://broker", options);
    EXPECT_EQ(options.host, "broker");
    EXPECT_EQ(options.port, 1883);
    EXPECT_FALSE(options.has_tls);
    publish::parse_url("mqtts://me:a@b:c@10.0.0.1:99/", options);
    EXPECT_EQ(options.host, "10.0.0.1");
    EXPECT_EQ(options.port, 99);
    EXPECT_TRUE(options.has_tls);
    EXPECT_EQ(options.user, "me");
    EXPECT_EQ(options.password, "a@b:c");
    for (const char* bad : {"broker", "http://broker", "mqtt://", "mqtt://a:0", "mqtt://a:x"})
        EXPECT_THROW(publish::parse_url(bad, options), BadArgument) << bad;
}

TEST_F(Mqtt, BrokerThatIsStoppedInMidRun) {
    Broker broker(directory_);
    // A session that the broker keeps, so that nothing it accepts is lost, and the order is seen.
    const std::string reader =
        fmt::format("mosquitto_sub -p {} -c -i reader -q 1 -t t ", broker.port());
    shell(reader + "-E");
    MqttOptions mqtt = options(broker);
    mqtt.qos = 1;
    mqtt.queue = 30;
    MqttPublisher publisher(mqtt);
    int published = 0;
    const auto publish = [&](int count) {
        for (int i = 0; i < count; ++i)
            publisher.publish("t", std::to_string(published++));
    };
    for (int i = 0; i < 10; ++i) {
        publish(1);
        std::this_thread::sleep_for(5ms);
    }
    ASSERT_TRUE(publisher.flush(5s));
    broker.stop();
    wait_until([&] { return !publisher.is_connected(); });
    publish(100);
    EXPECT_EQ(publisher.dropped(), 70);
    std::this_thread::sleep_for(3s);  // several attempts in vain
    broker.start();
    wait_until([&] { return publisher.is_connected(); });
    ASSERT_TRUE(publisher.flush(10s));
    EXPECT_EQ(publisher.sent() + publisher.dropped(), published);
    EXPECT_EQ(publisher.dropped(), 70);
    EXPECT_THAT(news_.text(), HasSubstr("is gone; trying to reach it again"));

    std::istringstream received(shell(reader + "-C 40 -W 10"));
    std::vector<int> numbers{std::istream_iterator<int>(received), {}};
    std::vector<int> expected;
    for (int i = 0; i < 10; ++i)
        expected.push_back(i);
    for (int i = 109; i >= 80; --i)  // the newest first
        expected.push_back(i);
    EXPECT_EQ(numbers, expected);
}

/// Numbers of the states that a broker kept for a session, in the order in which they came.
std::vector<int> header_ids(const std::string& lines) {
    std::istringstream stream(lines);
    std::vector<int> ids;
    for (std::string line; std::getline(stream, line);)
        ids.push_back(nlohmann::json::parse(line).at("headerId"));
    return ids;
}

TEST_F(Mqtt, WatchGoesOnWhileItsBrokerIsGoneForTenSeconds) {
    // At 50 frames/s, or as fast as this machine can; by frames the broker comes and goes.
    constexpr int kFrames = 700;
    constexpr auto kFrame = 20ms;
    constexpr int kGone = 100;
    constexpr int kBack = 600;
    std::atomic<int> taken = 0;
    Broker broker(directory_);
    const std::string reader = fmt::format("mosquitto_sub -p {} -c -i reader -q 1 -t '{}' ",
                                           broker.port(), "uagv/v2/dotpose/anna/state");
    shell(reader + "-E");
    shell("mkfifo frames");
    std::thread camera([&] {
        const GreyImage image = DriveCamera(188, 120).frame(Drive(), 0);
        // Closed on exec: the broker that is started meanwhile must not hold it open.
        std::FILE* pipe = std::fopen((directory_ / "frames").c_str(), "wbe");
        const auto begun = std::chrono::steady_clock::now();
        for (int i = 1; i <= kFrames; ++i) {
            std::fwrite(image.pixels.data(), 1, image.pixels.size(), pipe);
            std::fflush(pipe);
            taken = i;
            std::this_thread::sleep_until(begun + i * kFrame);
        }
        std::fclose(pipe);
    });
    std::thread trouble([&] {
        wait_until([&] { return taken >= kGone; }, 60s);
        broker.stop();
        wait_until([&] { return taken >= kBack; }, 120s);
        broker.start();
    });
    EXPECT_EQ(
        run("watch - --size 188x120 --fps 50 -o lines --robot anna --qos 1 --mqtt " + broker.url(),
            (directory_ / "frames").string()),
        0);
    camera.join();
    trouble.join();
    EXPECT_EQ(std::ranges::count(file("lines"), '\n'), kFrames);
    EXPECT_THAT(errors_, HasSubstr("is gone; trying to reach it again"));
    int sent = 0;
    int dropped = 0;
    const std::size_t counts = errors_.rfind("dotpose: ", errors_.find(" states published, "));
    ASSERT_EQ(std::sscanf(errors_.c_str() + counts, "dotpose: %d states published, %d dropped",
                          &sent, &dropped),
              2)
        << errors_;
    std::printf("%d states sent, %d dropped\n", sent, dropped);
    EXPECT_EQ(sent + dropped, kFrames + 1);  // the last one says that the robot is lost
    // Less the 50 states that are kept, and some until it is seen that the broker is gone.
    EXPECT_GT(dropped, kBack - kGone - 100);

    // One that was under way when the broker went may come twice.
    const std::vector<int> ids = header_ids(shell(reader + "-W 2 || true"));
    EXPECT_EQ(std::set<int>(ids.begin(), ids.end()).size(), static_cast<std::size_t>(sent));
    // After the gap the newest come first. A machine that is busy makes small gaps of its own.
    ASSERT_GT(ids.size(), 22U);
    auto before = ids.begin();
    for (auto i = ids.begin(); i + 1 != ids.end(); ++i) {
        if (i[1] - i[0] > before[1] - before[0]) before = i;
    }
    EXPECT_GT(before[1] - before[0], kBack - kGone - 100);
    ASSERT_GT(ids.end() - before, 20);
    EXPECT_TRUE(std::is_sorted(before + 1, before + 21, std::greater<>()));
}

TEST_F(Mqtt, StartsBeforeItsBroker) {
    auto broker = std::make_unique<Broker>(directory_);
    broker->stop();
    MqttOptions mqtt = options(*broker);
    mqtt.qos = 1;
    MqttPublisher publisher(mqtt);
    EXPECT_THAT(news_.text(), HasSubstr("cannot reach the broker 127.0.0.1:"));
    EXPECT_THAT(news_.text(), HasSubstr(": Connection refused; trying on"));
    publisher.publish("t", "1");
    broker->start();
    EXPECT_TRUE(publisher.flush(20s));
    EXPECT_EQ(publisher.sent(), 1);
}

TEST_F(Mqtt, TellsThatTheUserIsRefused) {
    shell("touch users; mosquitto_passwd -b users me secret");
    const Broker broker(directory_, (directory_ / "users").string());
    MqttOptions mqtt = options(broker);
    mqtt.user = "me";
    mqtt.password = "wrong";
    try {
        MqttPublisher publisher(mqtt);
        ADD_FAILURE() << "let in";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("refuses the connection: Connection Refused: "));
    }
    mqtt.password = "secret";
    MqttPublisher publisher(mqtt);
    publisher.publish("t", "1");
    EXPECT_TRUE(publisher.flush(5s));
    EXPECT_EQ(
        run("fleet --seconds 1 --mqtt mqtt://me:wrong@127.0.0.1:" + std::to_string(broker.port())),
        1);
    EXPECT_THAT(errors_, HasSubstr("refuses the connection"));
}

TEST_F(Mqtt, LastWillIsSentWhenTheRobotVanishes) {
    const Broker broker(directory_);
    std::mutex mutex;
    std::string heard;
    MqttSubscriber subscriber(options(broker), "will", [&](const auto&, const auto& payload) {
        const std::lock_guard lock(mutex);
        heard = payload;
    });
    const pid_t robot = fork();
    if (robot == 0) {
        MqttOptions mqtt = options(broker);
        mqtt.will_topic = "will";
        mqtt.will = "lost";
        MqttPublisher publisher(mqtt);
        publisher.publish("will", "here");
        publisher.flush(5s);
        kill(getpid(), SIGKILL);
    }
    waitpid(robot, nullptr, 0);
    wait_until([&] {
        const std::lock_guard lock(mutex);
        return heard == "lost";
    });
}

TEST_F(Mqtt, LastWillIsNotSentWhenTheRobotTakesItsLeave) {
    const Broker broker(directory_);
    std::atomic<bool> is_heard = false;
    MqttSubscriber subscriber(options(broker), "will",
                              [&](const auto&, const auto&) { is_heard = true; });
    for (int i = 0; i < 20; ++i) {
        MqttOptions mqtt = options(broker);
        mqtt.will_topic = "will";
        mqtt.will = "lost";
        mqtt.qos = 1;
        MqttPublisher publisher(mqtt);
        publisher.publish("t", "here");
        publisher.flush(5s);
    }
    std::this_thread::sleep_for(200ms);
    EXPECT_FALSE(is_heard);
}

TEST_F(Mqtt, FleetSeesAWatchedRobot) {
    const Broker broker(directory_);
    const DriveCamera camera(188, 120);
    const Drive drive;
    for (int i = 0; i < 20; ++i) {
        write_pgm(directory_ / ("f" + std::to_string(100 + i) + ".pgm"),
                  camera.frame(drive, 240 + i).view());
    }
    save_drive_sheets(directory_ / "table.json");
    std::thread fleet([&] {
        shell("'" DOTPOSE_TOOL "' fleet --mqtt " + broker.url() +
              " --sheets table.json --map fleet.svg --seconds 4 --every 0.2");
    });
    wait_until([&] { return fs::exists(directory_ / "fleet.svg"); });  // it has subscribed
    EXPECT_EQ(
        run("watch 'f*.pgm' --fps 200 --sheets table.json --robot anna --mqtt " + broker.url()), 0);
    EXPECT_THAT(errors_, HasSubstr("21 states published, 0 dropped"));
    fleet.join();
    const std::string table = file("out");
    EXPECT_THAT(table, HasSubstr("\nanna             lost  "));
    EXPECT_THAT(table, testing::ContainsRegex(" 21 +0\n"));
    EXPECT_THAT(table, HasSubstr("1 robots, 21 states, 0 bad"));
    EXPECT_THAT(file("fleet.svg"), HasSubstr("anna (lost)"));
    EXPECT_THAT(file("fleet.svg"), HasSubstr(">left<"));
}

TEST_F(Mqtt, TwoHundredRobots) {
    constexpr int kRobots = 200;
    constexpr int kStates = 50;
    const Broker broker(directory_);
    std::thread fleet([&] {
        shell("echo $$ > fleet.pid; exec '" DOTPOSE_TOOL "' fleet --qos 1 --mqtt " + broker.url() +
              " --map fleet.svg --every 0.2");
    });
    wait_until([&] { return fs::exists(directory_ / "fleet.svg"); });
    std::vector<std::unique_ptr<MqttPublisher>> robots;
    for (int i = 0; i < kRobots; ++i)
        robots.push_back(std::make_unique<MqttPublisher>(options(broker)));
    const auto begun = std::chrono::steady_clock::now();
    for (int n = 0; n < kStates; ++n) {
        for (int i = 0; i < kRobots; ++i) {
            const std::string name = fmt::format("robot{}", i);
            const auto now = std::chrono::system_clock::now().time_since_epoch();
            const auto us = std::chrono::duration_cast<std::chrono::microseconds>(now).count();
            const std::time_t seconds = us / 1'000'000;
            char time[40];
            const std::size_t size =
                std::strftime(time, sizeof time, "%FT%T", std::gmtime(&seconds));
            std::snprintf(time + size, sizeof time - size, ".%06dZ",
                          static_cast<int>(us % 1'000'000));
            const nlohmann::json state = {{"headerId", n},
                                          {"timestamp", time},
                                          {"serialNumber", name},
                                          {"state", "moving"},
                                          {"agvPosition",
                                           {{"localized", n + 1 < kStates},
                                            {"mapId", "table"},
                                            {"x", 0.1 * i},
                                            {"y", 0.01 * n},
                                            {"theta", 0},
                                            {"deviationRange", 1e-6}}},
                                          {"velocity", {{"vx", 0}, {"vy", 0.5}, {"omega", 0}}}};
            robots[static_cast<std::size_t>(i)]->publish(
                fmt::format("uagv/v2/dotpose/{}/state", name), state.dump());
        }
        std::this_thread::sleep_until(begun + (n + 1) * 20ms);
    }
    for (const auto& robot : robots)
        EXPECT_TRUE(robot->flush(20s));
    // Their last states say that they are lost.
    const auto are_all_lost = [&] {
        const std::string map = file("fleet.svg");
        int lost = 0;
        for (std::size_t at = 0; (at = map.find("(lost)", at)) != std::string::npos; ++at)
            ++lost;
        return lost == kRobots;
    };
    wait_until(are_all_lost, 60s);
    kill(std::stoi(file("fleet.pid")), SIGINT);
    fleet.join();
    const std::string table = file("out");
    EXPECT_THAT(table, HasSubstr("200 robots, 10000 states, 0 bad, latency median "));
    EXPECT_THAT(table, testing::Not(testing::ContainsRegex(" 50 +[1-9][0-9]*\n")));
    std::printf("%s", table.substr(table.rfind("200 robots")).c_str());
}

/// A state message of a robot that stands somewhere.
std::string state_message(int header_id, const std::string& time, const std::string& state,
                          const std::string& robot) {
    return nlohmann::json{{"headerId", header_id},
                          {"timestamp", time},
                          {"serialNumber", robot},
                          {"state", state},
                          {"agvPosition",
                           {{"localized", true},
                            {"mapId", "table"},
                            {"x", 0.1 * header_id},
                            {"y", 0.1},
                            {"theta", 0},
                            {"deviationRange", 1e-6}}},
                          {"velocity", {{"vx", 0}, {"vy", 0}, {"omega", 0}}}}
        .dump();
}

/// `dotpose fleet` in the background, until its subscription is there.
class WatchedFleet {
  public:
    WatchedFleet(const fs::path& directory, const std::string& arguments)
        : directory_(directory), thread_([directory, arguments] {
              run_shell("cd '" + directory.string() +
                        "' && echo $$ > fleet.pid && exec '" DOTPOSE_TOOL
                        "' fleet --map fleet.svg --every 0.2 " +
                        arguments + " > table 2> news");
          }) {
        wait_until([this] { return fs::exists(directory_ / "fleet.svg"); });
    }
    /// The last table.
    std::string table() {
        kill(std::stoi(read_file(directory_ / "fleet.pid")), SIGINT);
        thread_.join();
        return read_file(directory_ / "table");
    }

  private:
    fs::path directory_;
    std::thread thread_;
};

TEST_F(Mqtt, TopicsTellWhoARobotIsAndTextsDoNotActOnTheTerminal) {
    const Broker broker(directory_);
    WatchedFleet fleet(directory_, "--mqtt " + broker.url());
    MqttPublisher sender(options(broker));
    const std::string time = "2026-11-24T16:00:00.000000Z";
    sender.publish("uagv/v2/dotpose/anna/state", state_message(1, time, "moving", "bert"));
    sender.publish(
        "uagv/v2/dotpose/\xe2\x80\xae"
        "red/state",
        state_message(1, time, "\x1b]0;OWNED\x07\nroot moving", "\x1b[2J"));
    for (const char* bad : {"2026-11-24T16:00:nanZ", "2026-11-24T16:00:00", "", "now"})
        sender.publish("uagv/v2/dotpose/carl/state", state_message(1, bad, "moving", "carl"));
    sender.publish("uagv/v2/dotpose/\x1b[31mred/state", "{}");  // the library sends no such topic
    sender.publish("uagv/v2/dotpose/dora/state", std::string(1'000'000, '['));
    EXPECT_TRUE(sender.flush(20s));
    EXPECT_EQ(sender.dropped(), 1);
    std::this_thread::sleep_for(500ms);
    const std::string table = fleet.table();
    EXPECT_THAT(table, HasSubstr("\nanna  "));
    EXPECT_THAT(table, testing::Not(HasSubstr("bert")));
    EXPECT_THAT(table, HasSubstr("2 robots, 2 states, 5 bad"));
    EXPECT_EQ(std::ranges::count(table, '\n'), 4) << table;
    EXPECT_EQ(table.find_first_of("\x1b\x07"), std::string::npos);
}

TEST_F(Mqtt, ASenderWhoseClockWasSetBackIsFollowed) {
    const Broker broker(directory_);
    WatchedFleet fleet(directory_, "--mqtt " + broker.url());
    MqttOptions mqtt = options(broker);
    mqtt.qos = 1;
    MqttPublisher sender(mqtt);
    const auto send = [&](const char* robot, int header_id, const char* time) {
        sender.publish(fmt::format("uagv/v2/dotpose/{}/state", robot),
                       state_message(header_id, time, "moving", robot));
        EXPECT_TRUE(sender.flush(20s));
    };
    // Its numbers go on.
    send("anna", 7, "2026-11-24T16:00:00Z");
    send("anna", 8, "2026-11-24T15:00:00Z");
    // It was switched on again: the numbers begin anew as well.
    send("bert", 700, "2026-11-24T16:00:00Z");
    for (int i = 0; i < 6; ++i)
        send("bert", i, fmt::format("2026-11-24T15:00:0{}Z", i).c_str());
    // One message that came late is none of the newest.
    send("carl", 9, "2026-11-24T16:00:01Z");
    send("carl", 8, "2026-11-24T16:00:00Z");
    std::this_thread::sleep_for(500ms);
    const std::string table = fleet.table();
    EXPECT_THAT(table, testing::ContainsRegex("\nanna +moving +800.000 "));
    EXPECT_THAT(table, testing::ContainsRegex("\nbert +moving +500.000 "));
    EXPECT_THAT(table, testing::ContainsRegex("\ncarl +moving +900.000 "));
}

TEST_F(Mqtt, InventedNamesFillNoMemory) {
    constexpr int kNames = 12'000;
    const Broker broker(directory_);
    WatchedFleet fleet(directory_, "--qos 1 --mqtt " + broker.url());
    MqttOptions mqtt = options(broker);
    mqtt.qos = 1;
    mqtt.queue = kNames;
    MqttPublisher sender(mqtt);
    for (int i = 0; i < kNames; ++i) {
        sender.publish(fmt::format("uagv/v2/dotpose/invented{}/state", i),
                       state_message(1, "2026-11-24T16:00:00Z", "moving", "x"));
    }
    EXPECT_TRUE(sender.flush(60s));
    std::this_thread::sleep_for(1s);
    EXPECT_THAT(fleet.table(), HasSubstr("10000 robots, 12000 states, 0 bad"));
}

TEST_F(Mqtt, FleetNeedsABroker) {
    EXPECT_EQ(run("fleet"), 2);
    EXPECT_EQ(run("fleet --mqtt nonsense"), 2);
    EXPECT_THAT(errors_, HasSubstr("'nonsense' is not mqtt://HOST or mqtts://HOST"));
    EXPECT_EQ(run("watch nowhere.mp4 --robot a/b"), 2);
    EXPECT_THAT(errors_, HasSubstr("holds none of / + #"));
}

}  // namespace
}  // namespace dotpose::test
