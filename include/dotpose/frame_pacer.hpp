/// FramePacer: when to take the next frame, to spare a battery (paper section IV-A). While the
/// device moves, frames follow each other at once. When it has not moved for 5 s, one frame a
/// second is taken until one shows that it has moved.
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

/// When a device counts as moving, and how often it takes frames.
struct PacerOptions {
    /// Time without movement after which the device counts as stationary. A longer time costs
    /// energy; a shorter one delays the start after each short stop.
    std::int64_t stationary_after_us = 5'000'000;
    /// Time from frame to frame while stationary. A longer time saves energy and notices a start
    /// later.
    std::int64_t stationary_period_us = 1'000'000;
    /// Time from frame to frame while moving. Default 0: as fast as frames come.
    std::int64_t moving_period_us = 0;
    /// Distance per axis, in 2^-16 spacing, from the place where the device came to rest beyond
    /// which a fix counts as movement. Default: a tenth of a spacing. Must be well above the noise
    /// of a resting device.
    std::int32_t moved_q16 = 6554;
    /// Turn beyond which a fix counts as movement; 2^31 is half a turn. Default: one degree.
    std::int32_t turned_bam = 11'930'465;
    /// Whether a stationary device that no longer sees the pattern counts as moved, for example
    /// lifted. Default: yes. Set it to false where frames also fail at rest.
    bool lost_is_moved = true;
};

/// Whether the device moves, by the frames so far.
enum class Motion : std::uint8_t { moving, stationary };

/// Decides when the next frame is taken.
class FramePacer {
  public:
    explicit FramePacer(const PacerOptions& options = {}) : options_(options) {}

    /// Takes the result of a frame, with or without a fix, and the time, on any clock that does not
    /// run backwards. Returns the time from which the next frame is wanted.
    std::int64_t next_frame_us(const Fix& fix, std::int64_t time_us);

    /// Returns whether the device moves; a new pacer says `moving`.
    Motion motion() const { return motion_; }

  private:
    bool has_moved(const Fix& fix) const;

    PacerOptions options_;
    Motion motion_ = Motion::moving;
    bool has_begun_ = false;
    Fix rest_;  ///< where the device came to rest; has no fix if it was not seen since it moved
    std::int64_t rest_since_us_ = 0;
};

}  // namespace dotpose

#pragma GCC visibility pop
