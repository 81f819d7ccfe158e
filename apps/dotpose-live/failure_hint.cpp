#include "failure_hint.hpp"

#include <algorithm>
#include <bit>
#include <memory>

#include <fmt/core.h>

#include "image_copy.hpp"
#include "picture_advice.hpp"

namespace dotpose::cli {
namespace {

constexpr std::int64_t kWindow_us = 1'000'000;
/// Minimum number of failed frames within a second that triggers a hint. The number is small,
/// because slow cameras deliver only a few frames per second.
constexpr std::size_t kMinFrames = 3;
/// Maximum number of stored frames. Without this limit, memory use would grow if the time stamps of
/// a source did not advance.
constexpr std::size_t kMaxFrames = 2000;

std::string reason_with_advice(Record record, ImageView image, const DeviceOptions& options,
                               double bits_per_px) {
    const auto scratch = std::make_unique<LargeMemory>();
    record.advice =
        advice_on(image, {record.fix.status, options, record.code_is_given, bits_per_px}, *scratch);
    return reason(record);
}

}  // namespace

/// Counts the failed frames with each status, and keeps a copy of one frame per status for the
/// report at the end of the run. To avoid copying every frame, only the 1st, 2nd, 4th, 8th, ...
/// frame with a status is copied, replacing the previous copy. The copy is therefore always from
/// the more recent half of the frames with this status.
void FailureHint::remember(const Record& record, ImageView image, const DeviceOptions& options,
                           double bits_per_px) {
    ++frames_;
    if (record.fix.status == Status::ok) return;
    ++failed_;
    Failures& same_status = failures_[record.fix.status];
    if (std::has_single_bit(static_cast<std::uint64_t>(++same_status.count))) {
        same_status.record = record;
        same_status.image = copy_of(image);
    }
    options_ = options;
    bits_per_px_ = bits_per_px;
}

std::string FailureHint::at_end() const {
    if (2 * failed_ <= frames_) return {};
    const auto most = std::ranges::max_element(
        failures_, {}, [](const auto& entry) { return entry.second.count; });
    const Failures& failures = most->second;
    return fmt::format(
        "{} of {} frames were not located; {}: {}", failed_, frames_,
        failures.count == failed_ ? "one of them" : "one of the most frequent kind",
        reason_with_advice(failures.record, failures.image.view(), options_, bits_per_px_));
}

std::string FailureHint::after(const Reading& reading, ImageView image,
                               const DeviceOptions& options, double bits_per_px) {
    const Record& record = reading.record;
    remember(record, image, options, bits_per_px);
    last_second_.push_back({reading.time_us, record.fix.status != Status::ok});
    // A hint requires a full second of frames, so the oldest frame is kept until the second-oldest
    // frame is one second old.
    while (last_second_.size() > kMaxFrames ||
           (last_second_.size() > 1 && reading.time_us - last_second_[1].time_us >= kWindow_us)) {
        last_second_.pop_front();
    }
    const bool is_long_enough = reading.time_us - last_second_.front().time_us >= kWindow_us;
    const auto failed =
        static_cast<std::size_t>(std::ranges::count(last_second_, true, &Frame::has_failed));
    if (2 * failed <= last_second_.size()) {
        is_reported_ = false;
        return {};
    }
    const bool is_time = is_long_enough && failed >= kMinFrames && !is_reported_;
    if (!is_time || record.fix.status == Status::ok) return {};
    is_reported_ = true;
    return fmt::format("most frames of the last second were not located; the newest: {}",
                       reason_with_advice(record, image, options, bits_per_px));
}

}  // namespace dotpose::cli
