// Ideal grids and their dots, computed in double precision from plane geometry. The tests expect
// the stages to find these grids and dots.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/decode/grid.hpp"
#include "core/kernels/scores.hpp"
#include "dotpose/code.hpp"
#include "dotpose/tools/random.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose::core_test {

using namespace core;

inline constexpr std::array kCodeVariants{CodeVariant::anoto, CodeVariant::libdots,
                                          CodeVariant::microdots};

inline double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

inline Vec2 operator+(Vec2 a, Vec2 b) {
    return {a.x + b.x, a.y + b.y};
}
inline Vec2 operator-(Vec2 a, Vec2 b) {
    return {a.x - b.x, a.y - b.y};
}
inline Vec2 operator*(double s, Vec2 a) {
    return {s * a.x, s * a.y};
}
inline double length(Vec2 a) {
    return std::hypot(a.x, a.y);
}

/// Returns the nearest fixed-point value with `bits` fractional bits.
inline FixedVec fixed(Vec2 a, int bits) {
    return {static_cast<std::int32_t>(std::lround(std::ldexp(a.x, bits))),
            static_cast<std::int32_t>(std::lround(std::ldexp(a.y, bits)))};
}
inline Vec2 real(FixedVec a, int bits) {
    return {std::ldexp(a.x, -bits), std::ldexp(a.y, -bits)};
}

inline DetectedDot dot_at(Vec2 centre_px, int mass = 500, int area_px = 9) {
    return {fixed(centre_px, 8), static_cast<std::uint16_t>(mass),
            static_cast<std::uint16_t>(area_px)};
}

/// A grid in the image, in px. Intersection (i, j) is at origin + i u + j v.
struct Mesh {
    Vec2 u;
    Vec2 v;
    Vec2 origin;

    Vec2 at(double i, double j) const { return origin + i * u + j * v; }
    /// Returns the grid coordinates of an image point.
    Vec2 inverse(Vec2 p) const {
        const Vec2 d = p - origin;
        const double area = u.x * v.y - u.y * v.x;
        return {(d.x * v.y - d.y * v.x) / area, (u.x * d.y - u.y * d.x) / area};
    }
};

inline Mesh square_mesh(double spacing_px, double angle_rad, Vec2 origin) {
    const Vec2 u{spacing_px * std::cos(angle_rad), spacing_px * std::sin(angle_rad)};
    return {u, {-u.y, u.x}, origin};
}

inline Lattice lattice_of(const Mesh& mesh) {
    return {fixed(mesh.u, 16), fixed(mesh.v, 16), fixed(mesh.origin, 16)};
}
inline Mesh mesh_of(const Lattice& lattice) {
    return {real(lattice.u_q16, 16), real(lattice.v_q16, 16), real(lattice.origin_q16, 16)};
}

/// A dot and its intersection.
struct PlacedDot {
    FixedVec cell;
    Vec2 centre_px;
};

/// Returns the dots of the cells with |i|, |j| <= `reach`, except dots outside the image.
/// displacement(i, j) returns the displacement of a dot, in spacings.
template <typename Displacement>
std::vector<PlacedDot> placed_dots(const Mesh& mesh, int reach, Vec2 image_px,
                                   Displacement displacement) {
    std::vector<PlacedDot> dots;
    for (int j = -reach; j <= reach; ++j) {
        for (int i = -reach; i <= reach; ++i) {
            const Vec2 d = displacement(i, j);
            const Vec2 p = mesh.at(i + d.x, j + d.y);
            const bool is_seen =
                p.x >= 1 && p.y >= 1 && p.x <= image_px.x - 2 && p.y <= image_px.y - 2;
            if (is_seen) dots.push_back({{i, j}, p});
        }
    }
    return dots;
}

inline std::vector<DetectedDot> dots_of(const std::vector<PlacedDot>& placed) {
    std::vector<DetectedDot> dots;
    for (const PlacedDot& p : placed)
        dots.push_back(dot_at(p.centre_px));
    return dots;
}

/// Returns a displacement of a sixth of the spacing, in one of the four directions at random.
inline Vec2 random_displacement(Rng& rng) {
    const auto symbol = static_cast<Symbol>(rng.below(4));
    return {dx(symbol) / 6.0, dy(symbol) / 6.0};
}

/// The pattern as seen by a camera above it, without perspective. The image point p_px shows the
/// pattern point place + `at_centre` + R(theta) (p_px - centre_px) / spacing_px.
struct View {
    CodeVariant code = CodeVariant::anoto;
    Place place;     ///< the cell that is the origin of the pattern coordinates
    Vec2 at_centre;  ///< pattern point at the image centre, in spacings from `place`
    double theta_rad = 0;
    double spacing_px = 11;
    Vec2 image_px{188, 120};

    Vec2 centre_px() const { return {(image_px.x - 1) / 2, (image_px.y - 1) / 2}; }
    /// Displacements on the pattern, in spacings, that correspond to a displacement of one px along
    /// the image axes u and v. These vectors are the columns of R(theta) / spacing_px.
    Vec2 du() const { return {std::cos(theta_rad) / spacing_px, std::sin(theta_rad) / spacing_px}; }
    Vec2 dv() const { return {-du().y, du().x}; }
    Vec2 pattern(Vec2 p_px) const {
        const Vec2 r = p_px - centre_px();
        return at_centre + r.x * du() + r.y * dv();
    }
    Mesh mesh() const {
        // Uses the inverse rotation because a step along the x axis of the pattern is the image
        // vector (cos, -sin).
        Mesh m = square_mesh(spacing_px, -theta_rad, {});
        m.origin = centre_px() - at_centre.x * m.u - at_centre.y * m.v;
        return m;
    }
    /// Returns the grid of `mesh` in another orientation, as a stage might find it. `turn` maps
    /// steps of the returned grid to steps of the pattern. Cell (0, 0) of the returned grid is the
    /// intersection `zero` of the pattern.
    Mesh mesh_turned(QuarterTurn turn, FixedVec zero) const {
        const Mesh m = mesh();
        const auto along = [&](FixedVec step) { return step.x * m.u + step.y * m.v; };
        return {along(turn({1, 0})), along(turn({0, 1})), m.at(zero.x, zero.y)};
    }
};

/// Returns all dots in the view, ordered by pattern row.
inline std::vector<PlacedDot> pattern_dots(const View& view) {
    const auto displacement = [&](int i, int j) -> Vec2 {
        const Place at = moved(view.code, view.place, i, j);
        const Symbol symbol = symbol_at(view.code, at.cell, at.section);
        return {dx(symbol) / 6.0, dy(symbol) / 6.0};
    };
    const int reach =
        static_cast<int>(length(view.image_px) / view.spacing_px +
                         std::max(std::abs(view.at_centre.x), std::abs(view.at_centre.y))) +
        1;
    return placed_dots(view.mesh(), reach, view.image_px, displacement);
}

inline Place random_place(Rng& rng) {
    return {{rng.below(kPositionsPerAxis), rng.below(kPositionsPerAxis)},
            {static_cast<std::uint8_t>(rng.below(kSections)),
             static_cast<std::uint8_t>(rng.below(kSections))}};
}

inline View random_view(Rng& rng) {
    View view;
    view.place = random_place(rng);
    view.at_centre = {rng.uniform(), rng.uniform()};
    view.theta_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    return view;
}

/// A grid of matrices P, with storage for its cells.
struct OwnedGrid {
    explicit OwnedGrid(int side)
        : cells(static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {
        grid.storage = cells;
        grid.side = side;
    }
    std::vector<GridCell> cells;
    Grid grid;
};

}  // namespace dotpose::core_test
