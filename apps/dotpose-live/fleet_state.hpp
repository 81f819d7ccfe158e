/// The state of all robots of a broker, from their state messages.
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
    std::int64_t heard_us = 0;  ///< time of the last message, system clock
    StateCounts counts;
};

/// Statistics of the time from sending a message to receiving it, by the clocks of both computers.
struct Latency {
    double median_ms = 0;
    double p99_ms = 0;
};

class FleetState {
  public:
    /// Maximum number of robots. Beyond it, those with the oldest messages are removed.
    static constexpr std::size_t kMaxRobots = 10'000;

    using Listener = std::function<void(std::string_view robot, const RobotState& state)>;

    /// `listener` is called with each state that has not come before, by the thread that calls
    /// `take`.
    explicit FleetState(Listener listener = [](std::string_view, const RobotState&) {})
        : listener_(std::move(listener)) {}

    /// Takes a message. A state that is older than the newest of its robot is only counted,
    /// unless several of them follow each other: then the sender's clock was set back. Messages
    /// that are not valid are counted as bad. May be called by any thread.
    void take(std::string_view topic, std::string_view payload, std::int64_t now_us);

    /// Returns the robots by their names.
    std::vector<std::pair<std::string, FleetRobot>> robots() const;
    /// Returns the path of a robot; an empty one if it was removed.
    std::vector<draw::Point> path_mm(std::string_view robot) const;
    /// Returns what was counted of all robots, also of those that were removed.
    StateCounts counts() const;
    std::int64_t bad() const;
    /// Returns the statistics of the newest messages, about 130,000 at most.
    Latency latency() const;

  private:
    static constexpr std::size_t kLatencies = 1 << 17;
    static constexpr std::size_t kPath = 2000;
    /// Maximum number of points of all paths. With many robots, their paths are shorter.
    static constexpr std::size_t kAllPaths = 1 << 21;

    struct Robot {
        FleetRobot shown;
        StateNumbers numbers;
        std::vector<draw::Point> path_mm;
        std::list<const std::string*>::iterator place;  ///< in `by_age_`
    };

    void take_state(std::string_view name, RobotState state, std::int64_t now_us);
    void take_connection(std::string_view name, const RobotConnection& connection,
                         std::int64_t now_us);
    Robot& heard(std::string_view name);
    void remove_oldest();
    void extend_path(Robot& robot) const;
    void count_latency(float latency_ms);

    Listener listener_;
    mutable std::mutex mutex_;
    std::map<std::string, Robot, std::less<>> robots_;
    std::list<const std::string*> by_age_;  ///< names, oldest message first
    StateCounts of_removed_;
    std::vector<float> latencies_ms_;
    std::size_t next_latency_ = 0;
    std::int64_t bad_ = 0;
};

}  // namespace dotpose::cli
