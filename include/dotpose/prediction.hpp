/// Prediction: the expected pose in the next frame. With a prediction, a Locator needs only a
/// fraction of the time, because it measures the dots at their expected positions in the image and
/// compares their bits with the code. A prediction never makes a fix less reliable. If a frame does
/// not confirm the prediction, the frame is located without the prediction.
///
///     Fix fix = locator.locate(image);
///     for (;;) fix = locator.locate(image, Prediction::like(fix));
///
/// If the robot moves by more than half a spacing between frames, use `Tracker::predict` instead.
#pragma once

#include <cstdint>

#include "dotpose/export.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/geometry.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Expected map from the next image to the pattern, with its uncertainty.
struct Prediction {
    /// Map from the image to the pattern, in spacings relative to `place`.
    PlaneFromImage pattern_from_image;
    Place place;
    /// Typical distance between a dot and its intersection in the last frame, in units of 2^-16
    /// spacings.
    std::int32_t displacement_q16 = 65536 / 6;
    /// Standard deviation of x and y, in units of 2^-16 spacings. The search radius, in spacings,
    /// is min(3 sigma, 0.6) on a DeviceLocator, and min(3 sigma + 0.1, 0.6) on a Locator.
    std::int32_t sigma_q16 = 65536 / 5;
    /// Standard deviation of the angle, as a binary angle: 2^31 is half a turn. Default: 1.4
    /// degrees. The search ignores this value, and always covers rotations of up to 4 degrees.
    std::int32_t sigma_theta_bam = 1 << 24;
    /// Change of theta during the readout of a rolling shutter (see Fix). A DeviceLocator ignores
    /// this value.
    float readout_turn_rad = 0;

    /// Returns a prediction for a camera that has not moved since `fix`. The status of the fix must
    /// be ok.
    static Prediction like(const Fix& fix);
};

/// Returns the prediction after the camera has moved by `by_q16` and rotated by `turn_bam` about
/// the image point `pivot_q8`. `by_q16` is in the pattern frame, in units of 2^-16 spacings.
/// `turn_bam` is a binary angle: 2^31 is half a turn. `pivot_q8` is in units of 2^-8 px.
Prediction moved(const Prediction& prediction, CodeVariant code, FixedVec by_q16,
                 std::int32_t turn_bam, FixedVec pivot_q8);

}  // namespace dotpose

DOTPOSE_END_EXPORT
