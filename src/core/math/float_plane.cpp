#include "core/math/float_plane.hpp"

#include <algorithm>

#include "core/math/plane_units.hpp"

namespace dotpose::core {

FloatVec plane_point(const FloatPlane& plane, FloatVec px) {
    const float divisor = std::max(
        1 + plane.tilt_x * px.x + plane.tilt_y * px.y + plane.bend * (px.x * px.x + px.y * px.y),
        0.25F);
    return {plane.at_x + (plane.du_x * px.x + plane.dv_x * px.y) / divisor,
            plane.at_y + (plane.du_y * px.x + plane.dv_y * px.y) / divisor};
}

FloatPlane recentred(const FloatPlane& plane, FloatVec to_px) {
    const auto& [x, y] = to_px;
    const float divisor =
        std::max(1 + plane.tilt_x * x + plane.tilt_y * y + plane.bend * (x * x + y * y), 0.25F);
    const FloatVec way{(plane.du_x * x + plane.dv_x * y) / divisor,
                       (plane.du_y * x + plane.dv_y * y) / divisor};
    const FloatVec tilt{plane.tilt_x + 2 * plane.bend * x, plane.tilt_y + 2 * plane.bend * y};
    return {plane.at_x + way.x,
            plane.at_y + way.y,
            (plane.du_x - way.x * tilt.x) / divisor,
            (plane.du_y - way.y * tilt.x) / divisor,
            (plane.dv_x - way.x * tilt.y) / divisor,
            (plane.dv_y - way.y * tilt.y) / divisor,
            tilt.x / divisor,
            tilt.y / divisor,
            plane.bend / divisor};
}

bool is_within_reason(const FloatPlane& plane, float half_width_px, float half_height_px) {
    // Limit on the coordinates, in spacings: the range of PlaneFromImage::at_centre_q16.
    constexpr float kFarthest = 32768;
    constexpr float kFinest_px = 3;
    constexpr float kCoarsest_px = 400;
    // Minimum area of a mapped pixel, relative to that of a rectangle with the same side lengths.
    constexpr float kFlattest = 1.0F / 4;
    const float area = plane.du_x * plane.dv_y - plane.dv_x * plane.du_y;
    const float sides = std::sqrt((plane.du_x * plane.du_x + plane.du_y * plane.du_y) *
                                  (plane.dv_x * plane.dv_x + plane.dv_y * plane.dv_y));
    const float fold =
        std::abs(plane.tilt_x) * half_width_px + std::abs(plane.tilt_y) * half_height_px;
    // Comparisons with NaN are false, so a plane with a NaN is rejected.
    return std::abs(plane.at_x) < kFarthest && std::abs(plane.at_y) < kFarthest &&
           area * kFinest_px * kFinest_px < 1 && area * kCoarsest_px * kCoarsest_px > 1 &&
           area > kFlattest * sides && fold < 0.75F && std::isfinite(plane.bend);
}

PlaneFromImage fixed_plane(const FloatPlane& plane, FixedVec centre_q8) {
    return {centre_q8,
            {rounded(plane.at_x * kPower16), rounded(plane.at_y * kPower16)},
            {rounded(plane.du_x * kPower24), rounded(plane.du_y * kPower24)},
            {rounded(plane.dv_x * kPower24), rounded(plane.dv_y * kPower24)},
            {rounded(plane.tilt_x * kPower30), rounded(plane.tilt_y * kPower30)},
            rounded(plane.bend * kPower40)};
}

FloatPlane float_plane(const PlaneFromImage& plane) {
    const auto from = [](std::int32_t value, float unit) {
        return static_cast<float>(value) / unit;
    };
    return {from(plane.at_centre_q16.x, kPower16),   from(plane.at_centre_q16.y, kPower16),
            from(plane.du_q24.x, kPower24),          from(plane.du_q24.y, kPower24),
            from(plane.dv_q24.x, kPower24),          from(plane.dv_q24.y, kPower24),
            from(plane.perspective_q30.x, kPower30), from(plane.perspective_q30.y, kPower30),
            from(plane.lens_q40, kPower40)};
}

}  // namespace dotpose::core
