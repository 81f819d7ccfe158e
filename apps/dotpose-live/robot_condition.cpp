#include "robot_condition.hpp"

#include <algorithm>

namespace dotpose::cli {

std::string_view name_of(Condition condition) {
    constexpr std::string_view kNames[] = {"moving", "still", "lost", "silent", "gone"};
    return kNames[static_cast<int>(condition)];
}

Condition condition_of(const RobotState& newest, publish::Presence presence,
                       std::int64_t silence_us, const ConditionLimits& limits) {
    if (presence == publish::Presence::offline || silence_us > limits.gone_after_us) {
        return Condition::gone;
    }
    if (presence == publish::Presence::broken || silence_us > limits.silent_after_us) {
        return Condition::silent;
    }
    if (!newest.is_localized) return Condition::lost;
    return newest.state == "stationary" ? Condition::still : Condition::moving;
}

std::string reason_of(Condition condition, const RobotState& newest, publish::Presence presence) {
    if (is_fine(condition)) return {};
    if (condition == Condition::lost) {
        if (newest.sent_us == 0) return "no state yet";
        std::string reason = newest.reason;
        std::ranges::replace(reason, '_', ' ');
        return reason;
    }
    if (presence == publish::Presence::offline) return "disconnected";
    return presence == publish::Presence::broken ? "connection broke" : "no message";
}

}  // namespace dotpose::cli
