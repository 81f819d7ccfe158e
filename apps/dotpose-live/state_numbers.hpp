/// Classifies the states of a robot as new, late or repeated, based on their sequence numbers and
/// times, and counts missing states.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "state_message.hpp"

namespace dotpose::cli {

struct StateCounts {
    std::int64_t messages = 0;
    std::int64_t missed = 0;  ///< number of missing states, based on gaps in the sequence numbers
    std::int64_t late = 0;    ///< number of states that arrived after newer ones, not in `missed`
    /// Number of states received more than once. With QoS 1, some states are sent again after a
    /// connection was broken.
    std::int64_t repeated = 0;

    StateCounts& operator+=(const StateCounts& more);
};

class StateNumbers {
  public:
    enum class Arrival { news, late, repeated };

    /// Counts a state and classifies it. A state is `repeated` if it is among the states received
    /// last. Otherwise, it is `late` if its time is earlier than the time of the newest state and
    /// its number is not higher. All other states are `news`. If the number of a state that is
    /// `news` is lower than before, the robot was restarted. Several late states in ascending order
    /// of time indicate that the robot was restarted with an earlier clock. From the fifth such
    /// state on, they are `news`.
    Arrival take(const RobotState& state, StateCounts& counts);

  private:
    struct Sent {
        std::uint64_t number = 0;
        std::int64_t time_us = 0;
        bool operator==(const Sent&) const = default;
    };
    bool is_late(const Sent& sent);

    /// Number of recent states that are checked for repetitions.
    static constexpr std::size_t kRemembered = 64;

    bool is_first_ = true;
    Sent newest_;
    std::array<Sent, kRemembered> seen_{};  ///< indexed by the state number modulo the array size
    /// Number of consecutive states that are older than `newest_` but in ascending order of time.
    /// `doubted_us_` is the time of the last one.
    int doubts_ = 0;
    std::int64_t doubted_us_ = 0;
};

}  // namespace dotpose::cli
