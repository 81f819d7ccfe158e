// Creates first estimates of grids with random errors, and checks the grids that a stage computes
// from these estimates.
#pragma once

#include <gtest/gtest.h>

#include "../geometry.hpp"
#include "core/math/plane.hpp"

namespace dotpose::core_test {

/// Returns the mesh with random errors in length, angle and position. The maximum errors are those
/// of a first estimate.
inline Mesh spoilt(const Mesh& mesh, Rng& rng) {
    const auto turned = [&](Vec2 a) {
        const double angle = radians(rng.uniform(-1, 1));
        const double stretch = rng.uniform(0.97, 1.03);
        return Vec2{stretch * (a.x * std::cos(angle) - a.y * std::sin(angle)),
                    stretch * (a.x * std::sin(angle) + a.y * std::cos(angle))};
    };
    Mesh result{turned(mesh.u), turned(mesh.v), {}};
    result.origin = mesh.at(rng.uniform(-0.05, 0.05), rng.uniform(-0.05, 0.05));
    return result;
}

/// Expects that the plane maps the intersection of each dot to the dot's cell, within `tolerance`
/// spacings. The plane and the mesh may have their origins at different intersections.
inline void expect_grid(const PlaneFromImage& plane, const std::vector<PlacedDot>& dots,
                        const std::vector<Vec2>& intersections_px, double tolerance) {
    const auto at = [&](Vec2 p) { return real(core::plane_point_q16(plane, fixed(p, 8)), 16); };
    const Vec2 shift{std::round(at(intersections_px[0]).x - dots[0].cell.x),
                     std::round(at(intersections_px[0]).y - dots[0].cell.y)};
    for (std::size_t d = 0; d < dots.size(); ++d) {
        const Vec2 found = at(intersections_px[d]) - shift;
        ASSERT_NEAR(found.x, dots[d].cell.x, tolerance)
            << "cell " << dots[d].cell.x << ", " << dots[d].cell.y;
        ASSERT_NEAR(found.y, dots[d].cell.y, tolerance)
            << "cell " << dots[d].cell.x << ", " << dots[d].cell.y;
    }
}

inline std::vector<Vec2> intersections(const Mesh& mesh, const std::vector<PlacedDot>& dots) {
    std::vector<Vec2> places;
    for (const PlacedDot& d : dots)
        places.push_back(mesh.at(d.cell.x, d.cell.y));
    return places;
}

/// Returns the dots up to `reach` cells from the origin, displaced as in the pattern.
inline std::vector<PlacedDot> displaced_dots(const Mesh& mesh, int reach, Vec2 image_px, Rng& rng) {
    return placed_dots(mesh, reach, image_px, [&](int, int) { return random_displacement(rng); });
}

/// Returns the tolerance at a corner of the image, in spacings, for a fit with three parameters per
/// axis. Each of the n dots is displaced by 1/6 spacing along one random axis, which is 0.118
/// spacings rms per axis. In units of the variance of one dot, the variance at the corner is 1 / n
/// for the mean plus 3 / n for each of the two slopes. The tolerance is five standard deviations.
inline double affine_tolerance(const std::vector<PlacedDot>& dots) {
    return 5 * 0.118 * std::sqrt(7.0 / static_cast<double>(dots.size()));
}

inline FixedVec centre_q8(Vec2 image_px) {
    return fixed({(image_px.x - 1) / 2, (image_px.y - 1) / 2}, 8);
}

}  // namespace dotpose::core_test
