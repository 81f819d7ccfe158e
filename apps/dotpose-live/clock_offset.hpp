/// Offset between the clock of a robot and the monotonic clock of the receiver, estimated from the
/// time stamps of messages.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace dotpose::cli {

/// Estimates the clock offset as the minimum of (received - sent) over the messages of the last 10
/// to 20 seconds. Delays in the network and in queues can only increase this difference, so the
/// minimum is closest to the true offset. Older messages are ignored, because clocks drift.
class ClockOffset {
  public:
    void take(std::int64_t received_us, std::int64_t sent_us) {
        const std::int64_t offset_us = received_us - sent_us;
        if (received_us - begun_us_ >= kWindow_us) {
            earlier_us_ = current_us_;
            current_us_ = offset_us;
            begun_us_ = received_us;
        }
        current_us_ = std::min(current_us_, offset_us);
    }

    /// Discards all previous messages. Must be called after the robot's clock has been set back.
    void reset() { *this = {}; }

    /// Returns the offset in microseconds. At least one message must have been added.
    std::int64_t us() const { return std::min(earlier_us_, current_us_); }

  private:
    static constexpr std::int64_t kWindow_us = 10'000'000;
    static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();

    std::int64_t begun_us_ = 0;  ///< start of the current window
    std::int64_t earlier_us_ = kNone;
    std::int64_t current_us_ = kNone;
};

}  // namespace dotpose::cli
