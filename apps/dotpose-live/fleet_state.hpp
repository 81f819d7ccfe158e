/// What is known of all robots of a broker, from their state messages.
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
    std::int64_t heard_us = 0;  ///< system clock
    std::int64_t messages = 0;
    std::int64_t missed = 0;  ///< by the gaps in their numbers
    std::vector<draw::Point> path_mm;
    /// Messages in a row that are older than `newest`, each newer than the one before, and when the
    /// last of them was sent.
    int doubts = 0;
    std::int64_t doubted_sent_us = 0;
};

/// Figures of how long messages took, from the sender's clock to ours.
struct Latency {
    double median_ms = 0;
    double p99_ms = 0;
};

class FleetState {
  public:
    /// Remembers at most so many robots: of more, those that were heard longest ago go.
    static constexpr std::size_t kMostRobots = 10'000;

    /// Takes a message. One that is older than the newest of its robot counts, and changes nothing
    /// else, unless several such follow each other: then the sender's clock was set back. What is
    /// no state counts as bad. May be called by any thread.
    void take(const std::string& topic, const std::string& payload, std::int64_t now_us);

    std::map<std::string, FleetRobot> robots() const;
    std::int64_t messages() const;
    std::int64_t bad() const;
    /// Of the newest messages, at most some 10,000.
    Latency latency() const;

  private:
    static constexpr std::size_t kLatencies = 16384;
    static constexpr std::size_t kPath = 2000;
    /// Points of all paths together: of many robots, shorter paths are remembered.
    static constexpr std::size_t kAllPaths = 1 << 21;

    FleetRobot& heard(const std::string& name, std::int64_t now_us);
    void extend_path(FleetRobot& robot) const;

    mutable std::mutex mutex_;
    std::map<std::string, FleetRobot> robots_;
    std::set<std::pair<std::int64_t, std::string>> by_age_;  ///< heard_us and name of all robots
    std::vector<float> latencies_ms_;
    std::int64_t messages_ = 0;
    std::int64_t bad_ = 0;
};

/// The robots as lines of text, the head first.
std::string table_of(const FleetState& fleet, std::int64_t now_us);

/// The robots of one map, over its sheets.
draw::Map map_of(const FleetState& fleet, const std::string& map_id,
                 std::vector<draw::MapSheet> sheets);

}  // namespace dotpose::cli
