/// The state of all robots of a broker, from their state messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "draw/track_map.hpp"
#include "robot_state.hpp"

namespace dotpose::cli {

struct FleetRobot {
    RobotState newest;
    std::int64_t heard_us = 0;  ///< time of the last message, system clock
    std::int64_t messages = 0;
    std::int64_t missed = 0;  ///< number of missing messages, from gaps in their numbers
    std::vector<draw::Point> path_mm;
    /// Number of successive messages that are older than `newest` but newer than each other, and
    /// the time at which the last of them was sent.
    int doubts = 0;
    std::int64_t doubted_sent_us = 0;
};

/// Statistics of the time from sending a message to receiving it, by the clocks of both computers.
struct Latency {
    double median_ms = 0;
    double p99_ms = 0;
};

class FleetState {
  public:
    /// Most robots that are kept; beyond it, those with the oldest messages are removed.
    static constexpr std::size_t kMostRobots = 10'000;

    /// Takes a message. A message that is older than the newest of its robot is only counted,
    /// unless several of them follow each other: then the sender's clock was set back. Messages
    /// that are not valid states are counted as bad. May be called by any thread.
    void take(const std::string& topic, const std::string& payload, std::int64_t now_us);

    std::map<std::string, FleetRobot> robots() const;
    std::int64_t messages() const;
    std::int64_t bad() const;
    /// Returns the statistics of the newest messages, about 10,000 at most.
    Latency latency() const;

  private:
    static constexpr std::size_t kLatencies = 16384;
    static constexpr std::size_t kPath = 2000;
    /// Most points of all paths together; with many robots, their paths are shorter.
    static constexpr std::size_t kAllPaths = 1 << 21;

    FleetRobot& heard(const std::string& name, std::int64_t now_us);
    void extend_path(FleetRobot& robot) const;

    mutable std::mutex mutex_;
    std::map<std::string, FleetRobot> robots_;
    std::set<std::pair<std::int64_t, std::string>> by_age_;  ///< heard_us and name of each robot
    std::vector<float> latencies_ms_;
    std::int64_t messages_ = 0;
    std::int64_t bad_ = 0;
};

/// Returns a table of the robots as text, with a header line.
std::string table_of(const FleetState& fleet, std::int64_t now_us);

/// Returns the map with the robots that are on it and its sheets.
draw::Map map_of(const FleetState& fleet, const std::string& map_id,
                 std::vector<draw::MapSheet> sheets);

}  // namespace dotpose::cli
