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
    std::int64_t missed = 0;  ///< number of missing states, from gaps in the sequence
    std::int64_t late = 0;    ///< number of states that arrived after newer states; not in `missed`
    /// Number of repetitions of earlier states. With QoS 1, some states are sent again after a
    /// broken connection.
    std::int64_t repeated = 0;

    StateCounts& operator+=(const StateCounts& more);
};

class StateNumbers {
  public:
    enum class Arrival { news, late, repeated };

    /// Counts a state and returns its arrival. The arrival is `news` if the number of the state is
    /// higher than all earlier numbers, regardless of its time, or if its number is lower but its
    /// time is later, because the robot was restarted. A state with a lower number and an earlier
    /// time is `late`. If several late states arrive in ascending order of time, the robot was
    /// restarted with its clock set back, so these states become `news`.
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
