/// Geometry: points, and the map from an image to the paper plane.
///
/// Fixed point: the suffix _qN marks a value in units of 2^-N. Pixel coordinates: u points right
/// and v points down. The centre of the first pixel is (0, 0).
#pragma once

#include <cstdint>

#include "dotpose/export.hpp"
#include "dotpose/language.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Fixed-point vector or point.
struct FixedVec {
    std::int32_t x = 0;
    std::int32_t y = 0;
    friend constexpr bool operator==(const FixedVec&, const FixedVec&) = default;
};

/// Map from image points to points on the paper plane. Plane points are in spacings. With (x, y) in
/// px from `centre`:
///
///     plane = at_centre + (du x + dv y) / (1 + perspective . (x, y) + lens (x^2 + y^2)).
///
/// The map is exact for a tilted camera with radial lens distortion (paper, equation 2), if
/// `centre` is the distortion centre. The core clamps the divisor to at least 1/4, because the map
/// is singular where the divisor is 0.
struct PlaneFromImage {
    FixedVec centre_q8;      ///< image point at which (x, y) = (0, 0), in 2^-8 px
    FixedVec at_centre_q16;  ///< plane point at `centre`, in 2^-16 spacings
    FixedVec du_q24;  ///< displacement in the plane per pixel to the right, in 2^-24 spacings
    FixedVec dv_q24;  ///< displacement in the plane per pixel down, in 2^-24 spacings
    FixedVec perspective_q30;   ///< perspective coefficients, in 2^-30 / px
    std::int32_t lens_q40 = 0;  ///< lens distortion coefficient, in 2^-40 / px^2
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
