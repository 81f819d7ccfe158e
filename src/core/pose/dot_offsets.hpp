// Dot offsets: maps measured dots to the pattern, and computes their residuals.
#pragma once

#include "core/math/float_plane.hpp"

namespace dotpose::core {

/// Pattern position of a measured dot, and its residual, both in spacings.
struct DotOffset {
    FloatVec at;        ///< measured position
    FloatVec residual;  ///< vector from the measured to the printed position
    float squared() const { return residual.x * residual.x + residual.y * residual.y; }
};

/// Returns the position and the residual of dot `k`. `plane` maps the measured centre to the
/// pattern. `displacement` is the distance between a printed dot and its intersection, in spacings.
inline DotOffset dot_offset(const MeasuredDots& dots, std::size_t k, const FloatPlane& plane,
                            float displacement) {
    const FloatVec at = plane_point(plane, {dots.x[k], dots.y[k]});
    const std::int32_t x_bit = dots.bits[k] & 1;
    const std::int32_t y_bit = dots.bits[k] >> 1;
    const auto direction_x = static_cast<float>(y_bit - x_bit);
    const auto direction_y = static_cast<float>(x_bit + y_bit - 1);
    return {at,
            {dots.column[k] + displacement * direction_x - at.x,
             dots.row[k] + displacement * direction_y - at.y}};
}

}  // namespace dotpose::core
