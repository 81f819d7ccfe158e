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
    /// Number of states that arrived after newer states. These states are not included in `missed`.
    std::int64_t late = 0;
    /// Number of states received more than once. With QoS 1, some states are sent again after the
    /// connection breaks.
    std::int64_t repeated = 0;

    StateCounts& operator+=(const StateCounts& more);
};

class StateNumbers {
  public:
    enum class Arrival { news, late, repeated };

    /// Counts a state and classifies it:
    /// - `repeated`: the same state was received recently.
    /// - `late`: the state is older than the newest state, and its number is not higher.
    /// - `news`: any other state. If its number is lower than that of the newest state, the robot
    ///   was restarted.
    ///
    /// Late states in ascending order of time indicate that the clock of the robot was set back.
    /// The fifth consecutive such state is classified as `news` and becomes the newest state.
    Arrival take(const RobotState& state, StateCounts& counts);

  private:
    struct Sent {
        std::uint64_t number = 0;
        std::int64_t time_us = 0;
        bool operator==(const Sent&) const = default;
    };
    bool is_late(const Sent& sent);

    /// Number of recent states with which each new state is compared, to detect repetitions.
    static constexpr std::size_t kRemembered = 64;

    bool is_first_ = true;
    Sent newest_;
    std::array<Sent, kRemembered> seen_{};  ///< indexed by the state number modulo the array size
    /// Number of consecutive states that are older than `newest_` but in ascending order of time.
    /// `doubted_us_` is the time of the last such state.
    int doubts_ = 0;
    std::int64_t doubted_us_ = 0;
};

}  // namespace dotpose::cli
