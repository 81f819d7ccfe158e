// Publishes the states of many robots with QoS 1, and prints how many states were sent and
// acknowledged. Each robot publishes at a constant rate, and numbers its states from 0.
// docs/fleet.md contains the results.
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <thread>
#include <vector>

#include <fmt/core.h>
#include <sys/resource.h>

#include "../../apps/dotpose/command_line.hpp"
#include "connection.hpp"
#include "robots.hpp"

namespace dotpose::test {
namespace {

struct Arguments {
    int port = 1883;
    int robots = 2000;
    int first = 0;
    double hz = 20;
    double seconds = 10;
    int connections = 4;
    bool serves = false;
};

struct Outcome {
    std::int64_t published = 0;
    std::int64_t answered = 0;
    std::int64_t latest_us = 0;  ///< maximum delay of a publication, relative to its due time
};

/// Publishes all states of the robots over a connection. In each publication period, each robot
/// publishes one state, and the states of all robots are evenly spaced in time.
Outcome publish_all(Connection& connection, const Robots& robots, const Arguments& arguments) {
    constexpr std::int64_t kBatch_us = 1000;
    constexpr std::int64_t kPatience_us = 30'000'000;
    const auto total = static_cast<std::int64_t>(arguments.hz * arguments.seconds + 0.5) *
                       std::int64_t{robots.count()};
    const double between_us = 1e6 / (arguments.hz * robots.count());
    const auto due_us = [&](std::int64_t i) {
        return static_cast<std::int64_t>(static_cast<double>(i) * between_us);
    };
    const std::int64_t begun_us = monotonic_us();
    Outcome outcome;
    for (std::int64_t i = 0; i < total;) {
        const std::int64_t now_us = monotonic_us() - begun_us;
        outcome.latest_us = std::max(outcome.latest_us, now_us - due_us(i));
        const std::string timestamp = timestamp_now();
        for (; i < total && due_us(i) <= now_us && connection.has_room(); ++i) {
            const auto robot = static_cast<int>(i % robots.count());
            connection.publish(robots.topic(robot),
                               robots.state(robot, i / robots.count(), timestamp));
        }
        connection.exchange(begun_us + now_us + kBatch_us);
    }
    const std::int64_t end_us = monotonic_us() + kPatience_us;
    while (connection.answered() < total && monotonic_us() < end_us)
        connection.exchange(monotonic_us() + kBatch_us);
    outcome.published = connection.published();
    outcome.answered = connection.answered();
    return outcome;
}

double processor_s() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

int run(const Arguments& arguments) {
    const int connections = arguments.serves ? 1 : arguments.connections;
    std::vector<Outcome> outcomes(static_cast<std::size_t>(connections));
    std::atomic<bool> has_failed = false;
    std::vector<std::thread> threads;
    for (int c = 0; c < connections; ++c) {
        threads.emplace_back([&, c] {
            try {
                const int first = arguments.robots * c / connections;
                const Robots robots(arguments.first + first,
                                    arguments.robots * (c + 1) / connections - first);
                Connection connection =
                    arguments.serves
                        ? Connection::to_subscriber(arguments.port)
                        : Connection::to_broker(arguments.port,
                                                fmt::format("load-{}-{}", arguments.first, c));
                outcomes[static_cast<std::size_t>(c)] = publish_all(connection, robots, arguments);
            } catch (const std::exception& error) {
                fmt::print(stderr, "dotpose_fleet_load: {}\n", error.what());
                has_failed = true;
            }
        });
    }
    for (std::thread& thread : threads)
        thread.join();
    Outcome all;
    for (const Outcome& outcome : outcomes) {
        all.published += outcome.published;
        all.answered += outcome.answered;
        all.latest_us = std::max(all.latest_us, outcome.latest_us);
    }
    fmt::print(
        "{} robots, {} states published, {} answered, the latest {:.1f} ms after its time, "
        "{:.2f} s of processor time\n",
        arguments.robots, all.published, all.answered, static_cast<double>(all.latest_us) * 1e-3,
        processor_s());
    return has_failed || all.answered != all.published ? 1 : 0;
}

}  // namespace
}  // namespace dotpose::test

int main(int argc, char** argv) {
    dotpose::test::Arguments arguments;
    dotpose::cli::Command app(
        "Publishes the states of many robots to a broker on this computer, at QoS 1");
    app.add_option("--port", arguments.port, "Port of the broker")->capture_default_str();
    app.add_option("--robots", arguments.robots, "Number of robots")->capture_default_str();
    app.add_option("--first", arguments.first, "Number of the first robot")->capture_default_str();
    app.add_option("--hz", arguments.hz, "States of a robot per second")->capture_default_str();
    app.add_option("--seconds", arguments.seconds, "How long")->capture_default_str();
    app.add_option("--connections", arguments.connections, "Connections that the robots share")
        ->capture_default_str();
    app.add_flag("--serve", arguments.serves,
                 "Be the broker of one subscriber, which connects to the port");
    try {
        return app.parse(argc, argv) ? dotpose::test::run(arguments) : 0;
    } catch (const dotpose::cli::UsageError& error) {
        fmt::print(stderr, "dotpose_fleet_load: {}\n", error.what());
        return 2;
    }
}
