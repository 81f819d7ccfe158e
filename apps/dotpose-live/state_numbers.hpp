/// Classifies the states of one robot as news, late or repeated, by their sequence numbers and
/// times. Counts missing states.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "state_message.hpp"

namespace dotpose::cli {

struct StateCounts {
    std::int64_t messages = 0;
    std::int64_t missed = 0;  ///< number of missing states, computed from gaps between the numbers
    std::int64_t late = 0;    ///< number of states that arrived after newer states; not in `missed`
    /// Number of states that were received more than once. With QoS 1, some states are sent again
    /// after a broken connection.
    std::int64_t repeated = 0;

    StateCounts& operator+=(const StateCounts& more);
};

class StateNumbers {
  public:
    enum class Arrival { news, late, repeated };

    /// Counts a state and classifies it. A state is `repeated` if it is among the last states that
    /// were received. Otherwise, it is `late` if its time is earlier than that of the newest state
    /// and its number is not higher. All other states are `news`; if the number of such a state is
    /// lower, the robot was restarted. Several late states in ascending order of time show that the
    /// robot was restarted with its clock set back. From the fifth of them on, these states are
    /// `news`.
    Arrival take(const RobotState& state, StateCounts& counts);

  private:
    struct Sent {
        std::uint64_t number = 0;
        std::int64_t time_us = 0;
        bool operator==(const Sent&) const = default;
    };
    bool is_late(const Sent& sent);

    /// Number of most recent states among which repetitions are detected.
    static constexpr std::size_t kRemembered = 64;

    bool is_first_ = true;
    Sent newest_;
    std::array<Sent, kRemembered> seen_{};  ///< each state is stored at its number modulo the size
    /// Number of successive states that are older than `newest_` but in ascending order of time.
    /// `doubted_us_` is the time of the last of these states.
    int doubts_ = 0;
    std::int64_t doubted_us_ = 0;
};

}  // namespace dotpose::cli
