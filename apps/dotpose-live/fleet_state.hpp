/// State of all robots of a broker, computed from their state messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "draw/svg.hpp"
#include "state_message.hpp"
#include "state_numbers.hpp"

namespace dotpose::cli {

struct FleetRobot {
    RobotState newest;
    std::int64_t heard_us = 0;  ///< arrival time of the last message, system clock
    StateCounts counts;
};

/// Latency statistics of the messages, measured with the clocks of the sender and of the receiver.
struct Latency {
    double median_ms = 0;
    double p99_ms = 0;
};

class FleetState {
  public:
    /// Maximum number of robots. If there are more robots, the robot with the oldest message is
    /// removed.
    static constexpr std::size_t kMaxRobots = 10'000;

    using Listener = std::function<void(std::string_view robot, const RobotState& state)>;

    /// `listener` is called with each state that was not received before, in the thread that calls
    /// `take`.
    explicit FleetState(Listener listener = [](std::string_view, const RobotState&) {})
        : listener_(std::move(listener)) {}

    /// Takes a message. A state older than the newest state of its robot is only counted. If
    /// several older states follow each other in ascending order of time, the clock of the sender
    /// was set back, and the states are accepted. Invalid messages are counted as bad. Thread-safe.
    void take(std::string_view topic, std::string_view payload, std::int64_t now_us);

    /// Returns the robots, sorted by name.
    std::vector<std::pair<std::string, FleetRobot>> robots() const;
    /// Returns the path of a robot in mm, or an empty path if the robot was removed.
    std::vector<draw::Point> path_mm(std::string_view robot) const;
    /// Returns the sum of the counts of all robots, including removed robots.
    StateCounts counts() const;
    std::int64_t bad() const;
    /// Returns the statistics of the newest 131,072 messages, or of all messages if there are
    /// fewer.
    Latency latency() const;

  private:
    static constexpr std::size_t kLatencies = 1 << 17;
    static constexpr std::size_t kPath = 2000;
    /// Maximum total number of points of all paths. With more robots, each path is shorter.
    static constexpr std::size_t kAllPaths = 1 << 21;

    struct Robot {
        FleetRobot shown;
        StateNumbers numbers;
        std::vector<draw::Point> path_mm;
        std::list<const std::string*>::iterator place;  ///< position in `by_age_`
    };

    void take_state(std::string_view name, RobotState state, std::int64_t now_us);
    void take_connection(std::string_view name, const RobotConnection& connection,
                         std::int64_t now_us);
    Robot& touch(std::string_view name);
    void remove_oldest();
    void extend_path(Robot& robot) const;
    void count_latency(float latency_ms);

    Listener listener_;
    mutable std::mutex mutex_;
    std::map<std::string, Robot, std::less<>> robots_;
    std::list<const std::string*> by_age_;  ///< names of the robots, oldest message first
    StateCounts of_removed_;
    std::vector<float> latencies_ms_;
    std::size_t next_latency_ = 0;
    std::int64_t bad_ = 0;
};

}  // namespace dotpose::cli
