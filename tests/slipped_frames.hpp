/// Frames of sheets whose dots are not on a regular grid: wrinkled paper, and sheets whose two
/// halves are displaced relative to each other, by faulty paper feed or at a seam between two
/// sheets. The true pose is the pose of the shot. It refers to the part of the paper at the image
/// centre.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "dotpose/tools/random.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose::test {

/// A line, and the displacement and rotation of the dots beyond it.
struct Slip {
    double distance_grid = 0;  ///< distance of the line from the image centre
    double direction_rad = 0;  ///< direction of the normal of the line, from +x towards +y
    Vec2 shift_grid;  ///< displacement at the point on the line that is closest to the image centre
    double turn_rad = 0;
};

/// Returns half the extent of the view along a direction in the pattern, in spacings.
inline double half_extent_grid(const Shot& shot, double direction_rad) {
    const double from_u_axis = direction_rad - shot.pose.theta_rad;
    return (std::abs(std::cos(from_u_axis)) * shot.camera.width_px +
            std::abs(std::sin(from_u_axis)) * shot.camera.height_px) *
           shot.camera.mm_per_px / (2 * shot.page.pattern.spacing_mm);
}

/// Returns a random slip. Its line crosses the view at a random position and in a random direction.
/// The displacement is 0.05 to 0.5 spacings in a random direction, and the rotation is at most one
/// degree.
inline Slip draw_slip(const Shot& shot) {
    Rng rng(shot.seed, 3);
    Slip slip;
    slip.direction_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    slip.distance_grid = rng.uniform(0, half_extent_grid(shot, slip.direction_rad));
    const double length = rng.uniform(0.05, 0.5);
    const double angle_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    slip.shift_grid = {length * std::cos(angle_rad), length * std::sin(angle_rad)};
    slip.turn_rad = rng.uniform(-1, 1) * std::numbers::pi / 180;
    return slip;
}

inline void apply(const Slip& slip, Shot& shot) {
    const Vec2 normal{std::cos(slip.direction_rad), std::sin(slip.direction_rad)};
    const Vec2 hinge{x_grid(shot.pose) + slip.distance_grid * normal.x,
                     y_grid(shot.pose) + slip.distance_grid * normal.y};
    const double spacing_mm = shot.page.pattern.spacing_mm;
    shot.page.shift_mm = [=](Vec2 place_grid) {
        const Vec2 from{place_grid.x - hinge.x, place_grid.y - hinge.y};
        if (from.x * normal.x + from.y * normal.y <= 0) return Vec2{};
        const double c = std::cos(slip.turn_rad) - 1;
        const double s = std::sin(slip.turn_rad);
        return Vec2{spacing_mm * (slip.shift_grid.x + c * from.x - s * from.y),
                    spacing_mm * (slip.shift_grid.y + s * from.x + c * from.y)};
    };
}

/// Deforms the paper by three waves in random directions. Their wavelengths are 16 to 60 spacings,
/// and each wave displaces the dots by up to `amplitude_grid`.
inline void wrinkle(double amplitude_grid, Shot& shot) {
    struct Wave {
        Vec2 per_grid;  ///< radians per spacing
        double phase_rad;
        Vec2 amplitude_mm;
    };
    Rng rng(shot.seed, 4);
    const Vec2 pose{x_grid(shot.pose), y_grid(shot.pose)};
    std::array<Wave, 3> waves{};
    for (Wave& wave : waves) {
        const double turns =
            2 * std::numbers::pi / std::exp(rng.uniform(std::log(16), std::log(60)));
        const double direction_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
        const double moves_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
        const double amplitude_mm = amplitude_grid * shot.page.pattern.spacing_mm;
        wave = {{turns * std::cos(direction_rad), turns * std::sin(direction_rad)},
                rng.uniform(0, 2 * std::numbers::pi),
                {amplitude_mm * std::cos(moves_rad), amplitude_mm * std::sin(moves_rad)}};
    }
    // Computes a shift and a rotation that compensate for the waves at the image centre, so that
    // the paper is neither displaced nor rotated there.
    const Vec2 axis{std::cos(shot.pose.theta_rad), std::sin(shot.pose.theta_rad)};
    Vec2 shift_there_mm;
    double turn_mm = 0;  // per spacing
    for (const Wave& wave : waves) {
        const double s = std::sin(wave.phase_rad);
        shift_there_mm.x += s * wave.amplitude_mm.x;
        shift_there_mm.y += s * wave.amplitude_mm.y;
        turn_mm += std::cos(wave.phase_rad) *
                   (wave.per_grid.x * axis.x + wave.per_grid.y * axis.y) *
                   (wave.amplitude_mm.y * axis.x - wave.amplitude_mm.x * axis.y);
    }
    shot.page.shift_mm = [=](Vec2 place_grid) {
        const Vec2 from{place_grid.x - pose.x, place_grid.y - pose.y};
        Vec2 shift_mm{turn_mm * from.y - shift_there_mm.x, -turn_mm * from.x - shift_there_mm.y};
        for (const Wave& wave : waves) {
            const double s =
                std::sin(wave.per_grid.x * from.x + wave.per_grid.y * from.y + wave.phase_rad);
            shift_mm.x += s * wave.amplitude_mm.x;
            shift_mm.y += s * wave.amplitude_mm.y;
        }
        return shift_mm;
    };
}

}  // namespace dotpose::test
