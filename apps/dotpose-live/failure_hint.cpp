#include "failure_hint.hpp"

#include <algorithm>
#include <memory>

#include <fmt/core.h>

#include "picture_advice.hpp"

namespace dotpose::cli {
namespace {

constexpr std::int64_t kWindow_us = 1'000'000;
/// Fewest frames in a second that allow a judgement; slow cameras deliver no more.
constexpr std::size_t kLeastFrames = 3;
/// Most frames that are kept, in case the times of a source do not advance.
constexpr std::size_t kMostFrames = 2000;

}  // namespace

std::string FailureHint::after(const Reading& reading, ImageView image, const Options& options) {
    const Record& record = reading.record;
    last_second_.push_back({reading.time_us, record.fix.status != Status::ok});
    // The oldest frame that is kept must be a second old; until then it is too early to judge.
    while (last_second_.size() > kMostFrames ||
           (last_second_.size() > 1 && reading.time_us - last_second_[1].time_us >= kWindow_us)) {
        last_second_.pop_front();
    }
    const bool is_long_enough = reading.time_us - last_second_.front().time_us >= kWindow_us;
    const auto failed =
        static_cast<std::size_t>(std::ranges::count(last_second_, true, &Frame::has_failed));
    if (2 * failed <= last_second_.size()) {
        is_told_ = false;
        return {};
    }
    const bool is_time = is_long_enough && failed >= kLeastFrames && !is_told_;
    if (!is_time || record.fix.status == Status::ok) return {};
    is_told_ = true;
    const auto scratch = std::make_unique<LargeMemory>();
    Record newest = record;
    newest.advice = advice_on(image, record.fix.status, options, *scratch);
    return fmt::format("most frames of the last second were not located; the newest: {}",
                       reason(newest));
}

}  // namespace dotpose::cli
