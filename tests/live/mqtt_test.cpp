// Tests which messages the publisher sends to a mosquitto broker and which messages it drops. In
// some tests, the broker is stopped and restarted.
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

#include "../drive.hpp"
#include "mqtt_fixture.hpp"

namespace dotpose::test {
namespace {

using publish::MqttOptions;
using publish::MqttPublisher;
using publish::MqttSubscriber;
using testing::HasSubstr;

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
    // Creates a persistent session, in which the broker queues all accepted messages in order.
    const std::string reader =
        fmt::format("mosquitto_sub -h 127.0.0.1 -p {} -c -i reader -q 1 -t t ", broker.port());
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
    std::this_thread::sleep_for(3s);  // long enough for several failed attempts to connect
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
    for (int i = 109; i >= 80; --i)  // newest first
        expected.push_back(i);
    EXPECT_EQ(numbers, expected);
}

/// Returns the message numbers of the states, in the order in which the broker received them.
std::vector<int> header_ids(const std::string& lines) {
    std::istringstream stream(lines);
    std::vector<int> ids;
    for (std::string line; std::getline(stream, line);)
        ids.push_back(nlohmann::json::parse(line).at("headerId"));
    return ids;
}

TEST_F(Mqtt, WatchGoesOnWhileItsBrokerIsGoneForTenSeconds) {
    // Publishes 50 frames per second, or fewer on a slow machine. The broker is stopped after kGone
    // frames and restarted after kBack frames.
    constexpr int kFrames = 700;
    constexpr auto kFrame = 20ms;
    constexpr int kGone = 100;
    constexpr int kBack = 600;
    std::atomic<int> taken = 0;
    Broker broker(directory_);
    const std::string reader =
        fmt::format("mosquitto_sub -h 127.0.0.1 -p {} -c -i reader -q 1 -t '{}' ", broker.port(),
                    "uagv/v2/dotpose/anna/visualization");
    shell(reader + "-E");
    shell("mkfifo frames");
    std::thread camera([&] {
        const GreyImage image = DriveCamera(188, 120).frame(Drive(), 0);
        // The "e" mode closes the pipe on exec. Otherwise, the broker that is restarted in the
        // meantime would keep the pipe open.
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
    EXPECT_EQ(sent + dropped, kFrames);
    // Nearly all states of the gap must be dropped. The tolerance of 100 states covers the 50
    // states that remain in the queue, and the states that are published before the publisher
    // notices that the broker has stopped.
    EXPECT_GT(dropped, kBack - kGone - 100);

    // A state that is in transit when the broker stops may arrive twice.
    const std::vector<int> ids = header_ids(shell(reader + "-W 5 || true"));
    EXPECT_EQ(std::set<int>(ids.begin(), ids.end()).size(), static_cast<std::size_t>(sent));
    // After the gap, the newest states arrive first. On a busy machine, there may be further small
    // gaps.
    ASSERT_GT(ids.size(), 22U);
    auto before = ids.begin();
    for (auto i = ids.begin(); i + 1 != ids.end(); ++i) {
        if (i[1] - i[0] > before[1] - before[0]) before = i;
    }
    EXPECT_GT(before[1] - before[0], kBack - kGone - 100);
    // The newest 50 states were kept and arrive newest first. Other states may arrive in between:
    // states that were in transit when the broker stopped, and states of new frames.
    std::vector<int> waited;
    std::copy_if(before + 1, ids.end(), std::back_inserter(waited),
                 [&](int id) { return id > before[1] - 50 && id <= before[1]; });
    EXPECT_GE(waited.size(), 20U);
    EXPECT_TRUE(std::ranges::is_sorted(waited, std::greater<>()));
}

TEST_F(Mqtt, StartsBeforeItsBroker) {
    auto broker = std::make_unique<Broker>(directory_);
    broker->stop();
    MqttOptions mqtt = options(*broker);
    mqtt.qos = 1;
    MqttPublisher publisher(mqtt);
    EXPECT_THAT(news_.text(), HasSubstr("cannot reach the broker 127.0.0.1:"));
    EXPECT_THAT(news_.text(), HasSubstr(": Connection refused; trying again"));
    publisher.publish("t", "1");
    broker->start();
    EXPECT_TRUE(publisher.flush(20s));
    EXPECT_EQ(publisher.sent(), 1);
}

TEST_F(Mqtt, FindsItsBrokerAgainAsFastWithTls) {
    Broker broker(directory_, {}, true);
    MqttOptions mqtt = options(broker);
    mqtt.ca_file = broker.certificate();
    MqttPublisher publisher(mqtt);
    ASSERT_TRUE(publisher.is_connected()) << news_.text();
    broker.stop();
    wait_until([&] { return !publisher.is_connected(); });
    std::this_thread::sleep_for(1500ms);  // long enough for several failed attempts to connect
    broker.start();
    // The publisher tries to connect every half second. The library itself would wait ten seconds
    // between attempts.
    wait_until([&] { return publisher.is_connected(); }, 4s);
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

/// Returns `options` with a topic for the presence of the publisher. The publisher then publishes
/// its presence as a word on this topic.
MqttOptions with_presence(MqttOptions options) {
    options.presence_topic = "presence";
    options.presence = [](publish::Presence presence) -> std::string {
        switch (presence) {
            case publish::Presence::online:
                return "online";
            case publish::Presence::offline:
                return "offline";
            case publish::Presence::broken:
                break;
        }
        return "broken";
    };
    return options;
}

/// A subscriber that appends each received payload, followed by a space, to a string.
class Heard {
  public:
    /// The constructor returns after the broker has accepted the subscription.
    explicit Heard(const MqttOptions& options)
        : subscriber_(options, {"presence", "probe"},
                      [this](std::string_view topic, std::string_view payload) {
                          const std::lock_guard lock(mutex_);
                          is_subscribed_ |= topic == "probe";
                          if (topic == "presence") words_ += std::string(payload) + " ";
                      }) {
        MqttPublisher prober(options);
        wait_until([&] {
            prober.publish("probe", "");
            prober.flush(1s);
            const std::lock_guard lock(mutex_);
            return is_subscribed_;
        });
    }
    std::string words() const {
        const std::lock_guard lock(mutex_);
        return words_;
    }

  private:
    mutable std::mutex mutex_;
    std::string words_;
    bool is_subscribed_ = false;
    MqttSubscriber subscriber_;
};

TEST_F(Mqtt, PresenceIsBrokenWhenTheRobotVanishes) {
    const Broker broker(directory_);
    const Heard early(options(broker));
    const pid_t robot = fork();
    if (robot == 0) {
        const MqttPublisher publisher(with_presence(options(broker)));
        for (;;)
            pause();
    }
    wait_until([&] { return early.words() == "online "; });
    kill(robot, SIGKILL);
    waitpid(robot, nullptr, 0);
    wait_until([&] { return early.words() == "online broken "; });
    const Heard late(options(broker));
    wait_until([&] { return late.words() == "broken "; });
}

TEST_F(Mqtt, PresenceIsOfflineAfterACleanEnd) {
    const Broker broker(directory_);
    std::string expected;
    const Heard early(options(broker));
    for (int i = 0; i < 20; ++i) {
        MqttPublisher publisher(with_presence(options(broker)));
        expected += "online offline ";
    }
    wait_until([&] { return early.words() == expected; });
    EXPECT_EQ(early.words(), expected);
    const Heard late(options(broker));
    wait_until([&] { return late.words() == "offline "; });
}

TEST_F(Mqtt, PresenceIsOnlineAgainWhenTheBrokerIsBack) {
    Broker broker(directory_);
    MqttPublisher publisher(with_presence(options(broker)));
    broker.stop();
    wait_until([&] { return !publisher.is_connected(); });
    broker.start();
    wait_until([&] { return publisher.is_connected(); });
    const Heard late(options(broker));
    wait_until([&] { return late.words() == "online "; });
}

}  // namespace
}  // namespace dotpose::test
