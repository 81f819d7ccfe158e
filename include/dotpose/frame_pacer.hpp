/// FramePacer: determines the time of the next frame, to save power (paper section IV-A). While the
/// device moves, frames are taken without a pause. After 5 s without movement, frames are taken
/// once a second until a frame shows movement.
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

#include "dotpose/export.hpp"
#include "dotpose/fix.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Criteria for movement, and frame periods.
struct PacerOptions {
    /// Time without movement after which the device counts as stationary. A longer time costs
    /// energy. With a shorter time, short stops also count as stationary, which delays the
    /// detection of the next movement.
    std::int64_t stationary_after_us = 5'000'000;
    /// Period of frames while stationary. A longer period saves energy and delays the detection of
    /// movement.
    std::int64_t stationary_period_us = 1'000'000;
    /// Period of frames while moving. Default 0: as fast as possible.
    std::int64_t moving_period_us = 0;
    /// Distance along either axis, in units of 2^-16 spacings, beyond which the device counts as
    /// moved. The distance is measured from the place where the device came to rest. Default: a
    /// tenth of a spacing. The value must be well above the noise of a resting device.
    std::int32_t moved_q16 = 6554;
    /// Rotation beyond which the device counts as moved, as a binary angle: 2^31 is half a turn.
    /// Default: one degree.
    std::int32_t turned_bam = 11'930'465;
    /// True if a stationary device that no longer sees the pattern counts as moved, for example
    /// because it was lifted. Default: true. Set this option to false if frames also fail at rest.
    bool lost_is_moved = true;
};

/// State of motion of the device, as determined from the frames so far.
enum class Motion : std::uint8_t { moving, stationary };

/// Schedules frames. The frame rate is reduced while the device is stationary.
class FramePacer {
  public:
    explicit FramePacer(const PacerOptions& options = {}) : options_(options) {}

    /// Processes the result of a frame, with or without a fix. `time_us` is the time of the frame
    /// on any monotonic clock. Returns the earliest time of the next frame.
    std::int64_t next_frame_us(const Fix& fix, std::int64_t time_us);

    /// Returns the state of motion of the device, initially `moving`.
    Motion motion() const { return motion_; }

  private:
    bool has_moved(const Fix& fix) const;

    PacerOptions options_;
    Motion motion_ = Motion::moving;
    bool has_begun_ = false;
    /// Fix of the newest frame that counted as movement, relative to which later movement is
    /// measured. The first frame always counts as movement. The status is not ok if the frame had
    /// no fix.
    Fix rest_;
    std::int64_t rest_since_us_ = 0;  ///< time of the frame of `rest_`
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
