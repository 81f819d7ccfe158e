// Readout turn: the rotation of the scene in the image while a rolling shutter reads the rows.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/math/float_plane.hpp"

namespace dotpose::core {

struct UnitVec {
    float cos = 1;
    float sin = 0;
};

/// Returns the unit vector in the direction of an angle. The angle is clamped to [-1, 1] rad. The
/// error is at most 3e-6. The result is bit-identical on every processor, unlike the results of C
/// libraries.
inline UnitVec small_unit(float rad) {
    rad = std::clamp(rad, -1.0F, 1.0F);
    const float q = rad * rad;
    return {1 - q * (1.0F / 2 - q * (1.0F / 24 - q * (1.0F / 720 - q / 40320))),
            rad * (1 - q * (1.0F / 6 - q * (1.0F / 120 - q / 5040)))};
}

inline FloatVec rotated(FloatVec v, UnitVec by) {
    return {by.cos * v.x - by.sin * v.y, by.sin * v.x + by.cos * v.y};
}

/// Rotation and motion of a scene at constant rates, while a rolling shutter reads the rows from
/// top to bottom. Points are in px relative to the image centre. Row 0 is the middle row, and shows
/// the scene at time 0.
///
/// While the middle row is read, the image of a scene point p moves by drift + rad_per_row * (p -
/// axis)' px per row, where the prime denotes a rotation by 90 degrees. The scene point p appears
/// in the image at
///
///     seen = axis + R(row * rad_per_row) * (p - axis) + displacement(row), where row = seen.y.
///
/// R(a) is the rotation by the angle a. displacement(row) is the vector by which the scene point
/// `axis` has moved since row 0. Without the rotation, p would appear at the point q with q = p +
/// q.y * drift. The map from p to q is affine. The member functions convert between the images with
/// and without rotation.
struct ReadoutTurn {
    float rad_per_row = 0;
    FloatVec axis;   ///< point around which the scene rotates, at time 0
    FloatVec drift;  ///< velocity of `axis` at time 0, in px per row, with y < 1

    /// Returns the image point at which the scene point seen at `seen` would appear without
    /// rotation.
    FloatVec without_turn(FloatVec seen) const {
        if (rad_per_row == 0) return seen;
        const float row = seen.y;
        const FloatVec moved = displacement(row);
        const FloatVec turned{seen.x - axis.x - moved.x, seen.y - axis.y - moved.y};
        const FloatVec p = rotated(turned, small_unit(-rad_per_row * row));
        const float still_row = (p.y + axis.y) / (1 - drift.y);
        return {p.x + axis.x + still_row * drift.x, still_row};
    }

    /// Inverse of `without_turn`: returns the image point at which a scene point appears that would
    /// be at `still` without rotation. Uses `steps` steps of Newton's method. `row` is the
    /// approximate row of the result. The result is correct only where the scene moves down by less
    /// than one row while a row is read. Otherwise, several rows or none may show the scene point.
    FloatVec seen_from(FloatVec still, float row, int steps) const {
        if (rad_per_row == 0) return still;
        constexpr float kMinClosing = 0.05F;
        constexpr float kMaxRow = 4096;  // larger than any row number
        const FloatVec p{still.x - still.y * drift.x - axis.x,
                         still.y - still.y * drift.y - axis.y};
        for (;; --steps) {
            const FloatVec turned = rotated(p, small_unit(rad_per_row * row));
            const FloatVec moved = displacement(row);
            const FloatVec seen{axis.x + moved.x + turned.x, axis.y + moved.y + turned.y};
            if (steps == 0) return seen;
            const float fall = drift.y + rad_per_row * (seen.x - axis.x);
            row = std::clamp(row + (seen.y - row) / std::max(1 - fall, kMinClosing), -kMaxRow,
                             kMaxRow);
        }
    }

  private:
    /// Returns the displacement of the scene point `axis` between the readout of row 0 and the
    /// readout of `row`. The direction of motion turns with the scene, so the path is an arc.
    FloatVec displacement(float row) const {
        const float half = rad_per_row * row / 2;
        const FloatVec chord = rotated(drift, small_unit(half));
        const float length = row * (1 - half * half / 6);
        return {length * chord.x, length * chord.y};
    }
};

/// Computes the drift from a plane. Assumes that the camera looks straight at the paper. Only the
/// motion of the scene can then shear the image of a square grid or stretch it vertically.
inline FloatVec drift_of(const FloatPlane& plane) {
    const float square = plane.du_x * plane.du_x + plane.du_y * plane.du_y;
    return {-(plane.dv_x * plane.du_x + plane.dv_y * plane.du_y) / square,
            1 - (plane.dv_y * plane.du_x - plane.dv_x * plane.du_y) / square};
}

}  // namespace dotpose::core
