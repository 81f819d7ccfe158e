/// FramePacer: lowers the frame rate of a stationary device to save power (paper, section IV-A).
/// While the device moves, frames are captured continuously. After 5 s without movement, one frame
/// is captured per second. The full rate resumes as soon as a frame shows movement.
///
///     FramePacer pacer;
///     for (;;) {
///         const Fix fix = take_frame_and_locate();
///         sleep_until(pacer.next_frame_us(fix, now_us()));
///     }
///
/// The functions use no heap, no floating point and no global variables.
#pragma once

#include <cstdint>

#include "dotpose/export.hpp"
#include "dotpose/fix.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Criteria for movement, and frame periods.
struct PacerOptions {
    /// Time without movement after which the device is considered stationary. A longer time uses
    /// more energy. With a shorter time, the frame rate drops even during brief stops, which delays
    /// the detection of the next movement.
    std::int64_t stationary_after_us = 5'000'000;
    /// Frame period while stationary. A longer period saves energy but delays the detection of
    /// movement.
    std::int64_t stationary_period_us = 1'000'000;
    /// Frame period while moving. With the default of 0, frames are captured as fast as possible.
    std::int64_t moving_period_us = 0;
    /// Minimum displacement along either axis that counts as movement, in units of 2^-16 spacings.
    /// The displacement is measured from the position at which the device came to rest. Must be
    /// well above the noise of fixes at rest. Default: a tenth of a spacing.
    std::int32_t moved_q16 = 6554;
    /// Rotation that counts as movement, as a binary angle: 2^31 is half a turn. Default: one
    /// degree.
    std::int32_t turned_bam = 11'930'465;
    /// True if a stationary device that loses the pattern is assumed to be moving, because it may
    /// have been lifted. Set to false if frames also fail while the device is at rest.
    bool lost_is_moved = true;
};

/// Motion state of the device, determined from the frames so far.
enum class Motion : std::uint8_t { moving, stationary };

/// Schedules frames. Reduces the frame rate while the device is stationary.
class FramePacer {
  public:
    explicit FramePacer(const PacerOptions& options = {}) : options_(options) {}

    /// Processes the result of a frame, with or without a fix. `time_us` is the time of the frame
    /// on any monotonic clock. Returns the earliest time for the next frame.
    std::int64_t next_frame_us(const Fix& fix, std::int64_t time_us);

    /// Returns the current motion state. Initially `moving`.
    Motion motion() const { return motion_; }

  private:
    bool has_moved(const Fix& fix) const;

    PacerOptions options_;
    Motion motion_ = Motion::moving;
    bool has_begun_ = false;
    /// Reference for detecting movement: the result of the newest frame that counted as movement,
    /// with or without a fix. The first frame always counts as movement.
    Fix rest_;
    std::int64_t rest_since_us_ = 0;  ///< frame time of `rest_`
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
