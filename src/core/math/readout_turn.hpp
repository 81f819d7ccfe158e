// Readout turn: the rotation of the scene in the image while a rolling shutter reads the rows.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/math/float_plane.hpp"

namespace dotpose::core {

/// Cosine and sine of an angle.
struct UnitVec {
    float cos = 1;
    float sin = 0;
};

/// Returns the unit vector of an angle, which is clamped to -1 to 1 rad, with an error of at most
/// 3e-6. Unlike the functions of the C library, gives the same bits on every processor.
inline UnitVec small_unit(float rad) {
    rad = std::clamp(rad, -1.0F, 1.0F);
    const float q = rad * rad;
    return {1 - q * (1.0F / 2 - q * (1.0F / 24 - q * (1.0F / 720 - q / 40320))),
            rad * (1 - q * (1.0F / 6 - q * (1.0F / 120 - q / 5040)))};
}

inline FloatVec rotated(FloatVec v, UnitVec by) {
    return {by.cos * v.x - by.sin * v.y, by.sin * v.x + by.cos * v.y};
}

/// A scene that rotates and moves in the image at constant rates, while the rows are read from top
/// to bottom. Points are in px relative to the image centre, so the middle row is row 0. It shows
/// the scene before any motion.
///
/// The scene moves by drift + rad_per_row (p - axis)', where ' is a turn by a right angle, for each
/// row that is read. Its point p is seen at
///
///     seen = axis + R(row rad_per_row) (p - axis) + way(row), where row = seen.y.
///
/// Without the rotation, it would be seen at p + row drift, an affine map of the scene. The
/// functions convert between these two images. Without a rotation, both are equal.
struct ReadoutTurn {
    float rad_per_row = 0;
    FloatVec axis;   ///< the point that the rotation does not move
    FloatVec drift;  ///< motion of this point in the image, in px per row; below 1 down

    /// Returns the point at which the scene that is seen at `seen` would be seen without the
    /// rotation.
    FloatVec without_turn(FloatVec seen) const {
        const float row = seen.y;
        const FloatVec moved = way(row);
        const FloatVec turned{seen.x - axis.x - moved.x, seen.y - axis.y - moved.y};
        const FloatVec p = rotated(turned, small_unit(-rad_per_row * row));
        const float still_row = (p.y + axis.y) / (1 - drift.y);
        return {p.x + axis.x + still_row * drift.x, still_row};
    }

    /// The inverse of `without_turn`, by Newton's method: correct where a row is read faster than
    /// the scene moves down. `row` is the approximate row of the result.
    FloatVec seen_from(FloatVec still, float row, int steps) const {
        constexpr float kMinClosing = 0.05F;
        constexpr float kMaxRow = 4096;  // beyond every image
        const FloatVec p{still.x - still.y * drift.x - axis.x,
                         still.y - still.y * drift.y - axis.y};
        for (;; --steps) {
            const FloatVec turned = rotated(p, small_unit(rad_per_row * row));
            const FloatVec moved = way(row);
            const FloatVec seen{axis.x + moved.x + turned.x, axis.y + moved.y + turned.y};
            if (steps == 0) return seen;
            const float fall = drift.y + rad_per_row * (seen.x - axis.x);
            row = std::clamp(row + (seen.y - row) / std::max(1 - fall, kMinClosing), -kMaxRow,
                             kMaxRow);
        }
    }

  private:
    /// Returns the motion of the point `axis` of the scene until a row is read. Its direction
    /// turns with the scene, so the way is an arc.
    FloatVec way(float row) const {
        const float half = rad_per_row * row / 2;
        const FloatVec chord = rotated(drift, small_unit(half));
        const float length = row * (1 - half * half / 6);
        return {length * chord.x, length * chord.y};
    }
};

/// Returns the drift at which a camera straight above the paper sees the grid of a plane. The image
/// of a square grid is sheared and stretched along the columns only by the motion of the scene.
inline FloatVec drift_of(const FloatPlane& plane) {
    const float square = plane.du_x * plane.du_x + plane.du_y * plane.du_y;
    return {-(plane.dv_x * plane.du_x + plane.dv_y * plane.du_y) / square,
            1 - (plane.dv_y * plane.du_x - plane.dv_x * plane.du_y) / square};
}

}  // namespace dotpose::core
