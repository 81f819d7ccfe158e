#include "refusal_history.hpp"

namespace dotpose::cli {

void RefusalHistory::add(std::int64_t time_us, Status status) {
    constexpr std::int64_t kUs_per_s = 1'000'000;
    const std::int64_t second = time_us / kUs_per_s;
    // If the clock of a source is set back, later frames are counted in the newest second.
    if (seconds_.empty() || second > seconds_.back().second) seconds_.push_back({second, {}});
    ++seconds_.back().frames[status];
    while (seconds_.front().second <= seconds_.back().second - kSeconds)
        seconds_.pop_front();
}

}  // namespace dotpose::cli
