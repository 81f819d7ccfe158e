// Random planes, and the plane formula in double precision.
#pragma once

#include "geometry.hpp"

namespace dotpose::core_test {

/// Returns the pattern point seen at an image point. Evaluates the formula in PlaneFromImage in
/// double precision.
inline Vec2 formula(const PlaneFromImage& plane, Vec2 p) {
    const Vec2 r = p - real(plane.centre_q8, 8);
    const Vec2 perspective = real(plane.perspective_q30, 30);
    const double divisor = 1 + perspective.x * r.x + perspective.y * r.y +
                           std::ldexp(plane.lens_q40, -40) * (r.x * r.x + r.y * r.y);
    return real(plane.at_centre_q16, 16) +
           1 / divisor * (r.x * real(plane.du_q24, 24) + r.y * real(plane.dv_q24, 24));
}

/// Returns a plane without perspective or lens distortion, for a square image. The length of `dv`
/// is 0.8 to `longest` times that of `du`, and the two are approximately perpendicular.
inline PlaneFromImage affine_plane(double side_px, double spacing_px, double longest, Rng& rng) {
    const double angle = rng.uniform(0, 6.3);
    const Vec2 du{std::cos(angle) / spacing_px, std::sin(angle) / spacing_px};
    PlaneFromImage plane;
    plane.centre_q8 = fixed({side_px / 2, side_px / 2}, 8);
    plane.at_centre_q16 = fixed({rng.uniform(-3, 3), rng.uniform(-3, 3)}, 16);
    plane.du_q24 = fixed(du, 24);
    plane.dv_q24 = fixed({-du.y * rng.uniform(0.8, longest), du.x * rng.uniform(0.8, longest)}, 24);
    return plane;
}

}  // namespace dotpose::core_test
