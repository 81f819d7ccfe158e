/// FramePacer: when to take the next frame, to spare a battery (paper section IV-A). While the
/// device moves: at once. When it has not moved for 5 s: one frame a second, and back at the first
/// that shows that it has moved.
///
///     FramePacer pacer;
///     for (;;) {
///         const Fix fix = take_frame_and_locate();
///         sleep_until(pacer.next_frame_us(fix, now_us()));
///     }
///
/// No heap, no floating point, no globals.
#pragma once

#include <cstdint>

#include "dotpose/fix.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

struct PacerOptions {
    /// Without movement for this long, the device counts as stationary. Longer costs energy,
    /// shorter makes it slow to start after each short stop.
    std::int64_t stationary_after_us = 5'000'000;
    /// From frame to frame while stationary. Longer saves energy and notices a start later.
    std::int64_t stationary_period_us = 1'000'000;
    /// From frame to frame while moving. Default 0: as fast as frames come.
    std::int64_t moving_period_us = 0;
    /// A fix this far, per axis, from where the device came to rest is a movement; in 2^-16
    /// spacing. Default a tenth of a spacing. Must be well above the noise of a resting device.
    std::int32_t moved_q16 = 6554;
    /// The same for the angle, 2^31 being half a turn. Default one degree.
    std::int32_t turned_bam = 11'930'465;
    /// Whether a stationary device that no longer sees the pattern was moved: lifted, for example.
    /// Default yes. Say no where frames fail at rest.
    bool lost_is_moved = true;
};

enum class Motion : std::uint8_t { moving, stationary };

class FramePacer {
  public:
    explicit FramePacer(const PacerOptions& options = {}) : options_(options) {}

    /// Takes what a frame told, with or without a fix, and the time, which should not run
    /// backwards, on any clock. Returns the time from which the next frame is wanted.
    std::int64_t next_frame_us(const Fix& fix, std::int64_t time_us);

    /// Starts as moving.
    Motion motion() const { return motion_; }

  private:
    bool has_moved(const Fix& fix) const;

    PacerOptions options_;
    Motion motion_ = Motion::moving;
    bool has_begun_ = false;
    Fix rest_;  ///< where the device came to rest; without a fix if it was not seen since it moved
    std::int64_t rest_since_us_ = 0;
};

}  // namespace dotpose

#pragma GCC visibility pop
