// Makes views of the pattern with several kinds of errors in the dots, and compares fitted poses
// with the pose of the camera.
#pragma once

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "../reading.hpp"
#include "core/math/plane.hpp"

namespace dotpose::core_test {

/// Returns the error of the plane at a pixel, in spacings.
inline Vec2 error_at(const Reading& reading, const PlaneFromImage& found, Vec2 pixel) {
    const Vec2 zero{static_cast<double>(reading.zero.x), static_cast<double>(reading.zero.y)};
    const Vec2 expected = reading.view.pattern(pixel) - zero;
    return real(core::plane_point_q16(found, fixed(pixel, 8)), 16) - expected;
}

/// Expects that the value and the slopes of the plane are correct at a pixel.
inline void expect_pose(const Reading& reading, const PlaneFromImage& found, Vec2 pixel,
                        double tolerance) {
    const Vec2 error = error_at(reading, found, pixel);
    EXPECT_NEAR(error.x, 0, tolerance);
    EXPECT_NEAR(error.y, 0, tolerance);
    // Over half the image height, the slope error may add up to an error of `tolerance`.
    const View& view = reading.view;
    const double slope = 2 * tolerance / view.image_px.y;
    const PlaneFromImage flat = core::tangent(found, fixed(pixel, 8));
    EXPECT_NEAR(real(flat.du_q24, 24).x, view.du().x, slope);
    EXPECT_NEAR(real(flat.du_q24, 24).y, view.du().y, slope);
    EXPECT_NEAR(real(flat.dv_q24, 24).x, view.dv().x, slope);
    EXPECT_NEAR(real(flat.dv_q24, 24).y, view.dv().y, slope);
}

/// Returns a random view with its dots at their exact positions. `i` selects the code variant and
/// the turn. The initial grid is slightly inaccurate, which must not affect the result.
inline Reading reading_off_grid(int i, Rng& rng) {
    View view = random_view(rng);
    view.spacing_px = rng.uniform(6, 11);
    view.code = kCodeVariants[static_cast<std::size_t>(i % 3)];
    Reading reading(view, QuarterTurn{i % 4});
    reading.plane.at_centre_q16.x += 2000;
    reading.plane.du_q24.y += 3000;
    return reading;
}

/// Returns the dots of a view. Every eighth dot is displaced by `min_px` to 2 px.
inline std::vector<DetectedDot> dots_with_outliers(const View& view, double min_px, Rng& rng) {
    auto dots = dots_of(pattern_dots(view));
    for (std::size_t d = 0; d < dots.size(); d += 8) {
        const double angle = rng.uniform(0, 6.3);
        const double away_px = rng.uniform(min_px, 2);
        dots[d] =
            dot_at(real(dots[d].centre_q8, 8) + away_px * Vec2{std::cos(angle), std::sin(angle)});
    }
    return dots;
}

/// Returns the dots of a view, displaced by `displacement` spacings instead of the nominal 1/6
/// spacing.
inline std::vector<DetectedDot> dots_displaced_by(double displacement, const View& view) {
    std::vector<DetectedDot> dots;
    for (const PlacedDot& d : pattern_dots(view)) {
        const Vec2 own = view.mesh().at(d.cell.x, d.cell.y);
        dots.push_back(dot_at(own + 6 * displacement * (d.centre_px - own)));
    }
    return dots;
}

inline std::vector<DetectedDot> noisy_dots(const std::vector<PlacedDot>& placed, double sigma_px,
                                           Rng& rng) {
    std::vector<DetectedDot> dots;
    for (const PlacedDot& d : placed)
        dots.push_back(dot_at(d.centre_px + sigma_px * Vec2{rng.normal(), rng.normal()}));
    return dots;
}

}  // namespace dotpose::core_test
