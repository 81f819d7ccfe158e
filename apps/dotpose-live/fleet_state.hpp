/// State of all robots that are connected to a broker, based on their messages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clock_offset.hpp"
#include "draw/svg.hpp"
#include "natural_order.hpp"
#include "robot_condition.hpp"
#include "state_message.hpp"
#include "state_numbers.hpp"

namespace dotpose::cli {

/// The current time on two clocks of the computer that receives the messages.
struct Now {
    std::int64_t system_us = 0;  ///< microseconds since 1970
    /// Time in microseconds on a monotonic clock. The clock stops while there is no connection to
    /// the broker, so a lost connection does not make robots `silent`.
    std::int64_t watched_us = 0;
};

struct FleetRobot {
    /// Identifies the robot during this run of the program. A robot that reappears after its
    /// removal gets a new id.
    std::uint32_t id = 0;
    /// Newest state. While the robot is lost, contains its last known position, map and sheet.
    RobotState newest;
    bool has_place = false;  ///< true if `newest` contains a current or earlier position
    publish::Presence presence = publish::Presence::online;
    /// Time at which the robot sent its newest message, on the clock of Now::watched_us. The time
    /// is based on the time stamp of the message, because the message may have waited in a queue.
    std::int64_t alive_us = std::numeric_limits<std::int64_t>::min();
    /// Time at which the pose was lost, on the clock of Now::watched_us. Valid only while the robot
    /// is lost.
    std::int64_t lost_since_us = 0;
    StateCounts counts;
    std::optional<CameraReport> camera;  ///< newest report
    // The following members are set by FleetState::robots.
    Condition condition = Condition::lost;
    std::int64_t silence_us = 0;  ///< time since `alive_us`
    std::string reason;           ///< short reason for the condition, or empty
};

/// Message latency statistics, based on the clocks of the sender and the receiver.
struct Latency {
    double median_ms = 0;
    double p99_ms = 0;
};

/// Histogram of message latencies.
struct LatencyHistogram {
    /// Upper limits of the buckets in seconds. The last bucket has no upper limit.
    static constexpr std::array kLimits_s = {0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1,
                                             0.25,  0.5,    1.0,   2.5,  5.0,   10.0};

    std::array<std::int64_t, kLimits_s.size() + 1> counts{};
    double sum_s = 0;

    /// Adds a latency. A negative latency, which can result from a clock difference, is counted as
    /// 0.
    void add(double latency_s);
};

/// Camera frame counts since the start of this program, summed over all robots.
struct CameraTotals {
    std::uint64_t frames = 0;
    RefusedFrames refused{};
};

class FleetState {
  public:
    /// Maximum number of robots. When another robot appears, the robot that has sent no message
    /// for the longest time is removed.
    static constexpr std::size_t kMaxRobots = 10'000;

    using Listener = std::function<void(std::string_view robot, const RobotState& state)>;

    /// `listener` is called with each state that has not been received before, on the thread that
    /// calls `take`.
    explicit FleetState(
        Listener listener = [](std::string_view, const RobotState&) {}, ConditionLimits limits = {})
        : listener_(std::move(listener)), limits_(limits) {}

    /// Processes a message. A state that is older than the newest state of its robot is counted as
    /// late. Late states are passed to the listener, but do not change the robot. However, if
    /// several late states arrive in ascending order of time, the sender's clock is assumed to have
    /// been set back, and the states are accepted. An empty message on the connection topic removes
    /// the robot. Other invalid messages are counted as bad. Thread-safe.
    void take(std::string_view topic, std::string_view payload, const Now& now);

    /// Returns the robots and their conditions, sorted by name in natural order.
    std::vector<std::pair<std::string, FleetRobot>> robots(const Now& now) const;
    /// Returns the path of a robot in mm, or an empty path if the robot was removed.
    std::vector<draw::Point> path_mm(std::string_view robot) const;
    /// Returns every `step`-th of the newest `points` points of a path, oldest first.
    std::vector<draw::Point> trail_mm(std::string_view robot, std::size_t points,
                                      std::size_t step) const;
    /// Returns the message counts, summed over all robots, including removed robots.
    StateCounts counts() const;
    std::int64_t bad() const;
    /// Returns the statistics for the newest 131,072 messages, or for all messages if there are
    /// fewer.
    Latency latency() const;
    LatencyHistogram latency_histogram() const;
    CameraTotals camera_totals() const;

  private:
    static constexpr std::size_t kLatencies = 1 << 17;
    static constexpr std::size_t kPath = 2000;
    /// Maximum total number of points in all paths. Each path is limited to this number divided by
    /// the number of robots.
    static constexpr std::size_t kAllPaths = 1 << 21;

    struct Robot {
        FleetRobot shown;
        StateNumbers numbers;
        ClockOffset clock;
        std::vector<draw::Point> path_mm;
        std::list<const std::string*>::iterator place;  ///< position in `by_age_`
    };

    void take_state(std::string_view name, RobotState state, const Now& now);
    void take_connection(std::string_view name, const RobotConnection& connection, const Now& now);
    /// Updates `alive_us` and the presence of a robot when a state arrives. Not called for late
    /// states.
    static void note_sign_of_life(Robot& robot, const RobotState& state, const Now& now);
    Robot& touch(std::string_view name);
    void remove(std::string_view name);
    void extend_path(Robot& robot) const;
    void count_latency(float latency_ms);
    void count_frames(const CameraReport& report, const std::optional<CameraReport>& previous);

    Listener listener_;
    ConditionLimits limits_;
    mutable std::mutex mutex_;
    std::map<std::string, Robot, NaturalOrder> robots_;
    /// Names of the robots, in the order in which their last messages arrived.
    std::list<const std::string*> by_age_;
    StateCounts of_removed_;
    std::uint32_t next_id_ = 1;
    std::vector<float> latencies_ms_;
    std::size_t next_latency_ = 0;
    LatencyHistogram latency_histogram_;
    CameraTotals camera_totals_;
    std::int64_t bad_ = 0;
};

}  // namespace dotpose::cli
