#include "state_numbers.hpp"

#include <algorithm>
#include <utility>

namespace dotpose::cli {

StateCounts& StateCounts::operator+=(const StateCounts& more) {
    messages += more.messages;
    missed += more.missed;
    late += more.late;
    repeated += more.repeated;
    return *this;
}

StateNumbers::Arrival StateNumbers::take(const RobotState& state, StateCounts& counts) {
    const Sent sent{state.header_id, state.sent_us};
    const bool is_first = std::exchange(is_first_, false);
    const bool was_seen = std::exchange(seen_[sent.number % kRemembered], sent) == sent;
    ++counts.messages;
    if (was_seen && !is_first) {
        ++counts.repeated;
        return Arrival::repeated;
    }
    if (!is_first && is_late(sent)) {
        ++counts.late;
        counts.missed = std::max<std::int64_t>(counts.missed - 1, 0);
        return Arrival::late;
    }
    // If this number is higher than the previous number by more than 1, the states with the numbers
    // in between are missing. A lower number means that the robot was restarted, so no states are
    // missing.
    if (!is_first && sent.number > newest_.number) {
        constexpr std::uint64_t kMax = 1'000'000'000;
        counts.missed +=
            static_cast<std::int64_t>(std::min(sent.number - newest_.number - 1, kMax));
    }
    newest_ = sent;
    return Arrival::news;
}

bool StateNumbers::is_late(const Sent& sent) {
    constexpr int kDoubts = 5;
    if (sent.time_us >= newest_.time_us || sent.number > newest_.number) {
        doubts_ = 0;
        return false;
    }
    // After an interruption, the robot sends queued states newest first, so late states arrive in
    // descending order of time. If kDoubts older states arrive in ascending order instead, the
    // clock of the robot was set back, and the states are not late.
    doubts_ = sent.time_us > doubted_us_ || doubts_ == 0 ? doubts_ + 1 : 1;
    doubted_us_ = sent.time_us;
    if (doubts_ < kDoubts) return true;
    doubts_ = 0;
    return false;
}

}  // namespace dotpose::cli
