// Random planes of tilted cameras, and the formula of such a plane in double precision.
#pragma once

#include "core/math/float_plane.hpp"
#include "geometry.hpp"

namespace dotpose::core_test {

/// Computes pattern = at + (du x + dv y) / (1 + tilt . (x, y) + bend (x^2 + y^2)).
inline Vec2 formula(const core::FloatPlane& p, Vec2 px) {
    const double divisor = 1 + double{p.tilt_x} * px.x + double{p.tilt_y} * px.y +
                           double{p.bend} * (px.x * px.x + px.y * px.y);
    return {double{p.at_x} + (double{p.du_x} * px.x + double{p.dv_x} * px.y) / divisor,
            double{p.at_y} + (double{p.du_y} * px.x + double{p.dv_y} * px.y) / divisor};
}

/// Returns the plane of a nearly square grid, rotated by any angle. `tilt` is the tilt per px.
inline core::FloatPlane random_float_plane(double spacing_px, double tilt, Rng& rng) {
    const double angle = rng.uniform(0, 2 * std::numbers::pi);
    const double direction = rng.uniform(0, 2 * std::numbers::pi);
    const auto f = [](double value) { return static_cast<float>(value); };
    const double stretch = rng.uniform(0.95, 1.05);
    core::FloatPlane p;
    p.at_x = f(rng.uniform(-3, 3));
    p.at_y = f(rng.uniform(-3, 3));
    p.du_x = f(std::cos(angle) / spacing_px);
    p.du_y = f(std::sin(angle) / spacing_px);
    p.dv_x = f(-std::sin(angle) / spacing_px * stretch);
    p.dv_y = f(std::cos(angle) / spacing_px * stretch);
    p.tilt_x = f(tilt * std::cos(direction));
    p.tilt_y = f(tilt * std::sin(direction));
    return p;
}

/// Returns the image point that shows a pattern point. Uses Newton's method with finite
/// differences.
inline Vec2 image_of(const core::FloatPlane& plane, Vec2 pattern) {
    Vec2 px;
    for (int step = 0; step < 30; ++step) {
        constexpr double kStep = 1e-3;
        const Vec2 off = pattern - formula(plane, px);
        const Vec2 u = 1 / kStep * (formula(plane, px + Vec2{kStep, 0}) - formula(plane, px));
        const Vec2 v = 1 / kStep * (formula(plane, px + Vec2{0, kStep}) - formula(plane, px));
        const double area = u.x * v.y - u.y * v.x;
        px = px + Vec2{(off.x * v.y - off.y * v.x) / area, (u.x * off.y - u.y * off.x) / area};
    }
    return px;
}

}  // namespace dotpose::core_test
