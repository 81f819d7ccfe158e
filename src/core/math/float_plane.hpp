// Float plane: planes and vectors in single precision.
#pragma once

#include <cmath>

#include "core/math/plane.hpp"

namespace dotpose::core {

/// PlaneFromImage in single precision, without the centre of the plane. Maps an image point (x, y),
/// in px relative to this centre, to a pattern point in spacings:
///   pattern = at + (du x + dv y) / (1 + tilt . (x, y) + bend (x^2 + y^2))
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

/// Radial lens distortion (paper, equations 1-2). The distortion centre is relative to the plane
/// centre, in px.
struct FloatLens {
    float k = 0;  ///< distortion coefficient, in px^-2
    float centre_x = 0;
    float centre_y = 0;
};

struct FloatVec {
    float x = 0;
    float y = 0;
};

/// Maps an image point to the plane, in spacings. `px` is relative to the plane centre. Clamps the
/// divisor to at least 1/4, because the map folds where the divisor reaches 0.
FloatVec plane_point(const FloatPlane& plane, FloatVec px);

/// Returns the same plane with its centre moved to the image point `to_px`. The result is
/// approximate if the plane has a lens term.
FloatPlane recentred(const FloatPlane& plane, FloatVec to_px);

/// Returns the grid spacing at the plane centre, in px.
inline float spacing_px(const FloatPlane& plane) {
    return 1 / std::sqrt(std::abs(plane.du_x * plane.dv_y - plane.dv_x * plane.du_y));
}

/// Returns true if the plane is a plausible view of paper:
/// - the spacing is between 3 and 400 px,
/// - the sine of the angle between the mapped image axes exceeds 1/4,
/// - the map does not fold within the image, and
/// - the coordinates fit in PlaneFromImage.
///
/// Returns false if a value is NaN.
bool is_within_reason(const FloatPlane& plane, float half_width_px, float half_height_px);

PlaneFromImage fixed_plane(const FloatPlane& plane, FixedVec centre_q8);
FloatPlane float_plane(const PlaneFromImage& plane);

}  // namespace dotpose::core
