// Dot offsets: where dots lie in the pattern, and how far from where the code has them.
#pragma once

#include "core/math/float_plane.hpp"

namespace dotpose::core {

/// A measured dot in the pattern, in spacings.
struct DotOffset {
    FloatVec at;   ///< where it was measured
    FloatVec off;  ///< from there to its place in the code
    float squared() const { return off.x * off.x + off.y * off.y; }
};

/// Returns where a plane has a measured dot, and how far that is from its place in the code.
/// `displacement` is that of dots from their intersections, in spacings.
inline DotOffset dot_offset(const MeasuredDots& dots, std::size_t k, const FloatPlane& plane,
                            float displacement) {
    const FloatVec at = plane_point(plane, {dots.x[k], dots.y[k]});
    const std::int32_t x_bit = dots.bits[k] & 1;
    const std::int32_t y_bit = dots.bits[k] >> 1;
    const auto way_x = static_cast<float>(y_bit - x_bit);
    const auto way_y = static_cast<float>(x_bit + y_bit - 1);
    return {
        at,
        {dots.column[k] + displacement * way_x - at.x, dots.row[k] + displacement * way_y - at.y}};
}

}  // namespace dotpose::core
