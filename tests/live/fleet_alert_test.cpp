// Tests that `dotpose fleet` shows and reports robots that are silent, lost or removed, and robots
// whose process was killed. Uses a mosquitto broker and a terminal.
#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mqtt_fixture.hpp"
#include "robot_message.hpp"
#include "watched_fleet.hpp"

namespace dotpose::test {
namespace {

using publish::MqttPublisher;
using testing::HasSubstr;

/// Runs `dotpose fleet` on a terminal of 24 rows and 80 columns.
class TerminalFleet {
  public:
    TerminalFleet(const fs::path& directory, const std::string& arguments) {
        winsize size{24, 80, 0, 0};
        process_ = forkpty(&terminal_, nullptr, nullptr, &size);
        if (process_ == 0) {
            const std::string command =
                "cd '" + directory.string() + "' && exec '" + tool_path() + "' fleet " + arguments;
            execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
            _exit(127);
        }
        fcntl(terminal_, F_SETFL, O_NONBLOCK);
    }
    ~TerminalFleet() {
        if (process_ > 0) finish("q");
        close(terminal_);
    }
    TerminalFleet(const TerminalFleet&) = delete;
    TerminalFleet& operator=(const TerminalFleet&) = delete;

    void press(const std::string& keys) {
        ASSERT_EQ(write(terminal_, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
    }
    /// Returns the newest complete screen. Each line ends with "\033[K".
    std::string screen() {
        receive();
        const std::size_t end = output_.rfind("\033[J");
        if (end == std::string::npos) return {};
        const std::size_t begin = output_.rfind("\033[H", end) + 3;
        return output_.substr(begin, end - begin);
    }
    /// Sends keys that end the program, and returns its exit status.
    int finish(const std::string& keys) {
        press(keys);
        int status = 0;
        while (waitpid(process_, &status, WNOHANG) == 0) {
            receive();
            std::this_thread::sleep_for(5ms);
        }
        receive();
        process_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    const std::string& output() const { return output_; }

  private:
    void receive() {
        char block[65536];
        ssize_t size = 0;
        while ((size = read(terminal_, block, sizeof block)) > 0)
            output_.append(block, static_cast<std::size_t>(size));
    }

    int terminal_ = -1;
    pid_t process_ = 0;
    std::string output_;
};

class Alerts {
  public:
    explicit Alerts(publish::MqttOptions options)
        : subscriber_(std::move(options), {"dotpose/alerts/+"},
                      [this](std::string_view topic, std::string_view payload) {
                          const auto alert = nlohmann::json::parse(payload);
                          const std::lock_guard lock(mutex_);
                          words_ += fmt::format("{} {} ({}); ", topic.substr(15),
                                                alert["condition"].get<std::string>(),
                                                alert.value("reason", ""));
                      }) {}
    std::string words() const {
        const std::lock_guard lock(mutex_);
        return words_;
    }
    bool has(const std::string& alert) const { return words().find(alert) != std::string::npos; }

  private:
    mutable std::mutex mutex_;
    std::string words_;
    publish::MqttSubscriber subscriber_;
};

/// A simulated robot that publishes a state every 100 ms.
class Driving {
  public:
    Driving(const publish::MqttOptions& options, std::string name)
        : name_(std::move(name)), publisher_(options), thread_([this] { drive(); }) {}
    ~Driving() { end(); }
    void lose(const std::string& reason) {
        const std::lock_guard lock(mutex_);
        reason_ = reason;
    }
    void end() {
        ends_ = true;
        if (thread_.joinable()) thread_.join();
    }

  private:
    void drive() {
        for (int i = 0; !ends_; ++i) {
            Message message{.robot = name_, .header_id = i, .time = time_now()};
            {
                const std::lock_guard lock(mutex_);
                message.is_localized = reason_.empty();
                message.reason = reason_;
            }
            publisher_.publish(state_topic(name_), message.json());
            std::this_thread::sleep_for(100ms);
        }
    }

    std::string name_;
    std::mutex mutex_;
    std::string reason_;
    std::atomic<bool> ends_ = false;
    MqttPublisher publisher_;
    std::thread thread_;
};

class FleetAlert : public Mqtt {
  protected:
    /// Starts a process that connects to the broker as a robot and registers its last will. Returns
    /// the process ID.
    pid_t connect_with_will(const Broker& broker, const std::string& robot) {
        const pid_t process = fork();
        if (process == 0) {
            const std::string port = std::to_string(broker.port());
            const std::string topic = connection_topic(robot);
            const std::string will = connection_json("CONNECTIONBROKEN", time_now());
            execlp("mosquitto_sub", "mosquitto_sub", "-p", port.c_str(), "-t", "none",
                   "--will-topic", topic.c_str(), "--will-payload", will.c_str(), "--will-retain",
                   nullptr);
            _exit(127);
        }
        return process;
    }
};

TEST_F(FleetAlert, KilledSilentLostAndRemovedRobotsAreShownWithinTwoSeconds) {
    constexpr auto kLimit = 2s;
    const Broker broker(directory_);
    const Alerts alerts(options(broker));
    TerminalFleet fleet(directory_,
                        "--alerts --silent-after 2 --gone-after 4 --mqtt " + broker.url());
    const pid_t killed_process = connect_with_will(broker, "killed");
    Driving killed(options(broker), "killed");
    Driving silenced(options(broker), "silenced");
    Driving lost(options(broker), "lost");
    const auto shows = [&](const char* row) {
        return fleet.screen().find(row) != std::string::npos;
    };
    wait_until([&] {
        return shows("killed         moving") && shows("silenced       moving") &&
               shows("lost           moving");
    });
    EXPECT_EQ(alerts.words(), "");

    lost.lose("too_few_dots");
    wait_until([&] { return shows("lost           lost"); }, kLimit);
    wait_until([&] { return alerts.has("lost lost (too few dots); "); }, 1s + kLimit);
    EXPECT_THAT(fleet.screen(), HasSubstr("too few dots, table"));

    killed.end();
    kill(killed_process, SIGKILL);
    waitpid(killed_process, nullptr, 0);
    wait_until([&] { return alerts.has("killed silent (connection broke); "); }, kLimit);
    wait_until([&] { return shows("killed         silent"); }, kLimit);

    silenced.end();
    wait_until([&] { return alerts.has("silenced silent (no message); "); }, 2s + kLimit);
    wait_until([&] { return shows("silenced       silent"); }, kLimit);
    wait_until([&] { return alerts.has("silenced gone (no message); "); }, 2s + kLimit);
    wait_until([&] { return shows("silenced       gone"); }, kLimit);

    EXPECT_EQ(run("fleet remove killed --mqtt " + broker.url()), 0) << errors_;
    EXPECT_EQ(output_, "removed killed\n");
    wait_until([&] { return alerts.has("killed removed (); "); }, kLimit);
    wait_until([&] { return !shows("killed"); }, kLimit);
    // The retained messages of the robot must also have been removed from the broker.
    EXPECT_EQ(run("fleet remove killed --mqtt " + broker.url()), 1);
    EXPECT_THAT(errors_, HasSubstr("knows no robot killed"));
    EXPECT_EQ(fleet.finish("q"), 0);
    EXPECT_THAT(fleet.output(), HasSubstr("alerts published, 0 dropped"));
}

TEST_F(FleetAlert, TheTerminalScrollsAndIsRestored) {
    const Broker broker(directory_);
    TerminalFleet fleet(directory_, "--every 0.1 --mqtt " + broker.url());
    const auto shows = [&](const char* text) {
        return fleet.screen().find(text) != std::string::npos;
    };
    wait_until([&] { return shows("0-0 of 0"); });
    publish::MqttOptions mqtt = options(broker);
    mqtt.queue = 500;
    MqttPublisher sender(mqtt);
    for (int i = 1; i <= 500; ++i) {
        const std::string name = fmt::format("robot{}", i);
        sender.publish(state_topic(name), Message{.robot = name, .time = time_now()}.json());
    }
    EXPECT_TRUE(sender.flush(20s));
    wait_until([&] { return shows("1-20 of 500"); });
    EXPECT_EQ(std::ranges::count(fleet.screen(), '\n'), 23);
    fleet.press("n\033[6~");
    wait_until([&] { return shows("21-40 of 500, by name") && shows("robot21 "); });
    fleet.press("\033[F");
    wait_until([&] { return shows("481-500 of 500") && shows("robot500 "); });
    fleet.press("\033[H\033[B\033OB");
    wait_until([&] { return shows("3-22 of 500"); });
    EXPECT_EQ(fleet.finish("\003"), 0);  // Ctrl-C
    EXPECT_THAT(fleet.output(), HasSubstr("\033[?1049l"));
    const std::string last = fleet.output().substr(fleet.output().rfind("\033[?1049l"));
    EXPECT_THAT(last, HasSubstr("500 robots, 500 states"));
    EXPECT_LE(std::ranges::count(last, '\n'), 24);
}

TEST_F(FleetAlert, RefusesLimitsAndNamesThatAreNone) {
    const std::string nowhere = fmt::format(" --mqtt mqtt://127.0.0.1:{}", free_port());
    EXPECT_EQ(run("fleet --silent-after 10 --gone-after 5" + nowhere), 2);
    EXPECT_EQ(run("fleet remove a/b" + nowhere), 2);
    EXPECT_EQ(run("fleet remove" + nowhere), 2);
    EXPECT_EQ(run("fleet remove anna"), 2);
    EXPECT_EQ(run("fleet remove anna" + nowhere), 1);
    EXPECT_THAT(errors_, HasSubstr("was never reached"));
}

}  // namespace
}  // namespace dotpose::test
