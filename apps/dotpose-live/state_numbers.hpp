/// Classifies the states of one robot by their numbers and times: new, missing, late, repeated.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "state_message.hpp"

namespace dotpose::cli {

struct StateCounts {
    std::int64_t messages = 0;
    std::int64_t missed = 0;    ///< missing so far, from gaps in the numbers
    std::int64_t late = 0;      ///< came after newer ones; they are no longer missing
    std::int64_t repeated = 0;  ///< came before; at QoS 1 a connection that breaks repeats some

    StateCounts& operator+=(const StateCounts& more);
};

class StateNumbers {
  public:
    enum class Arrival { news, late, repeated };

    /// Takes a state, and counts it. It is news if its number is higher than all before, whatever
    /// the sender's clock says, or its time is later: then the robot has started again. If both are
    /// lower, it is late, unless several such states ascend: then the robot has started again with
    /// its clock set back.
    Arrival take(const RobotState& state, StateCounts& counts);

  private:
    struct Sent {
        std::uint64_t number = 0;
        std::int64_t time_us = 0;
        bool operator==(const Sent&) const = default;
    };
    bool is_late(const Sent& sent);

    /// Number of newest states whose repetitions are recognized.
    static constexpr std::size_t kRemembered = 64;

    bool is_first_ = true;
    Sent newest_;
    std::array<Sent, kRemembered> seen_{};  ///< each at its number modulo the size
    /// Number of successive states that are older than `newest_` but newer than each other, and the
    /// time at which the last of them was sent.
    int doubts_ = 0;
    std::int64_t doubted_us_ = 0;
};

}  // namespace dotpose::cli
