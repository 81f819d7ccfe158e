// Planes in single precision, as the attempts of desktops use them.
#pragma once

#include <cmath>

#include "core/math/plane.hpp"

namespace dotpose::core {

/// PlaneFromImage in single precision, from px to spacings: pattern = at + (du x + dv y) / (1 +
/// tilt . (x, y) + bend (x^2 + y^2)).
struct FloatPlane {
    float at_x = 0;
    float at_y = 0;
    float du_x = 0;
    float du_y = 0;
    float dv_x = 0;
    float dv_y = 0;
    float tilt_x = 0;
    float tilt_y = 0;
    float bend = 0;
};

/// The lens of eq. 1-2, for points counted from the plane's centre, in px.
struct FloatLens {
    float k = 0;  ///< per px^2
    float centre_x = 0;
    float centre_y = 0;
};

struct FloatVec {
    float x = 0;
    float y = 0;
};

/// Returns the place, in spacings, of an image point in px from the centre. The divisor is limited
/// to at least a quarter, because planes fold farther away.
FloatVec plane_point(const FloatPlane& plane, FloatVec px);

/// Returns the same plane counted from another point of the image; with a bend it is an
/// approximation.
FloatPlane recentred(const FloatPlane& plane, FloatVec to_px);

/// Returns the px per spacing at the centre.
inline float spacing_px(const FloatPlane& plane) {
    return 1 / std::sqrt(std::abs(plane.du_x * plane.dv_y - plane.dv_x * plane.du_y));
}

/// Whether a camera may see paper like this: the grid is neither finer nor coarser than dots can be
/// measured, not seen from behind or from the side, not folded within the image, and counted from
/// nearby. Returns false if any value is not a number.
bool is_within_reason(const FloatPlane& plane, float half_width_px, float half_height_px);

PlaneFromImage fixed_plane(const FloatPlane& plane, Vec centre_q8);
FloatPlane float_plane(const PlaneFromImage& plane);

}  // namespace dotpose::core
