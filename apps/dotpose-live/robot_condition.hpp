/// Conditions of the robots in a fleet, as shown to operators.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "publish/mqtt.hpp"
#include "state_message.hpp"

namespace dotpose::cli {

enum class Condition {
    moving,
    still,
    lost,    ///< the pose is unknown, for example because no pattern is in view
    silent,  ///< no message for some time, or the connection is broken
    gone,    ///< no message for a long time, or the robot has disconnected
};
inline constexpr int kConditionCount = 5;

/// Returns the identifier of a condition, such as "moving".
std::string_view name_of(Condition condition);

/// Returns true if the current pose of the robot is known.
inline bool is_fine(Condition condition) {
    return condition == Condition::moving || condition == Condition::still;
}

struct ConditionLimits {
    std::int64_t silent_after_us = 5'000'000;
    std::int64_t gone_after_us = 60'000'000;  ///< must be at least `silent_after_us`
};

/// Returns the condition of a robot. `newest` is the newest state of the robot, `presence` is the
/// state of the robot's connection, and `silence_us` is the time since the robot's newest message.
Condition condition_of(const RobotState& newest, publish::Presence presence,
                       std::int64_t silence_us, const ConditionLimits& limits);

/// Returns a short reason for the condition, or an empty string if the reason is unknown.
std::string reason_of(Condition condition, const RobotState& newest, publish::Presence presence);

}  // namespace dotpose::cli
