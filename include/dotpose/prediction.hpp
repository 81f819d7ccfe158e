/// Prediction: the expected place of the pattern in the next frame. With a prediction, a Locator
/// finds the next fix in a fraction of the time: it measures dots at their expected places and
/// confirms every bit. A prediction never makes a fix less certain, because a frame that does not
/// confirm the prediction is located without it.
///
///     Fix fix = locator.locate(image);
///     for (;;) fix = locator.locate(image, Prediction::like(fix));
///
/// If the robot moves by more than half a spacing between frames, use `Tracker::predict` instead.
#pragma once

#include <cstdint>

#include "dotpose/fix.hpp"
#include "dotpose/geometry.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// The expected map from the image to the pattern, with its uncertainty.
struct Prediction {
    /// The map from the image to the pattern, in spacings relative to `place`.
    PlaneFromImage pattern_from_image;
    Place place;
    /// Typical distance of a dot from its intersection in the last frame, in units of 2^-16
    /// spacings.
    std::int32_t displacement_q16 = 65536 / 6;
    /// Standard deviations of the predicted pose. The search covers three standard deviations, but
    /// at most 0.6 spacing and 4 degrees.
    std::int32_t sigma_q16 = 65536 / 5;  ///< standard deviation of x and y, in 2^-16 spacing
    /// Standard deviation of the angle. 2^31 is half a turn. Default: 1.4 degrees.
    std::int32_t sigma_theta_bam = 1 << 24;

    /// Returns the prediction for a camera that does not move after the frame of `fix`. The fix
    /// must be ok.
    static Prediction like(const Fix& fix);
};

/// Returns the prediction for a camera that has moved by `by_q16` (units of 2^-16 spacings, pattern
/// frame) and turned by `turn_bam` (2^31 is half a turn) about the image point `pivot_q8` (2^-8
/// px).
Prediction moved(const Prediction& prediction, CodeVariant code, FixedVec by_q16,
                 std::int32_t turn_bam, FixedVec pivot_q8);

}  // namespace dotpose

#pragma GCC visibility pop
