/// Prediction: where the pattern is expected in the next frame. Whoever hands one to a Locator gets
/// the next fix in a fraction of the time: dots are measured where they are expected, and every bit
/// is confirmed. A prediction never makes a fix less certain: what the frame does not confirm is
/// refused, and the frame located afresh.
///
///     Fix fix = locator.locate(image);
///     for (;;) fix = locator.locate(image, Prediction::like(fix));
///
/// A robot that moves by more than half a spacing between frames has `Tracker::predict` make it.
#pragma once

#include <cstdint>

#include "dotpose/fix.hpp"
#include "dotpose/geometry.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

struct Prediction {
    /// The map from the image to the pattern, counted in spacings from `place`.
    PlaneFromImage pattern_from_image;
    Place place;
    /// Of dots from their intersections, in spacings, as last seen.
    std::int32_t displacement_q16 = 65536 / 6;
    /// Standard deviations of the pose. The pattern is looked for within three of them, but at most
    /// 0.6 spacing and 4 degrees off.
    std::int32_t sigma_q16 = 65536 / 5;      ///< of x and of y, spacings
    std::int32_t sigma_theta_bam = 1 << 24;  ///< 1.4 degrees

    /// The next frame will look like this one, whose fix is ok.
    static Prediction like(const Fix& fix);
};

/// The prediction if the camera goes on by so much of the pattern's frame, in spacings, and turns
/// by so much about the image point `pivot_q8`, in px.
Prediction moved(const Prediction& prediction, Profile profile, Vec by_q16, std::int32_t turn_bam,
                 Vec pivot_q8);

}  // namespace dotpose

#pragma GCC visibility pop
