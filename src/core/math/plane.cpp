#include "core/math/plane.hpp"

namespace dotpose::core {
namespace {

/// Returns du x + dv y in units of 2^-16 spacings, clamped to +-kBeyondReason.
FixedVec linear_q16(const PlaneFromImage& plane, FixedVec from_centre_q8) {
    const std::int64_t x = from_centre_q8.x;
    const std::int64_t y = from_centre_q8.y;
    const auto component = [&](std::int64_t du_q24, std::int64_t dv_q24) {
        constexpr std::int64_t kMax_q32 = std::int64_t{kBeyondReason} << 16;
        return shift_rounded(std::clamp(du_q24 * x + dv_q24 * y, -kMax_q32, kMax_q32), 16);
    };
    return {component(plane.du_q24.x, plane.dv_q24.x), component(plane.du_q24.y, plane.dv_q24.y)};
}

}  // namespace

PlaneFromImage plane_from_lattice(const Lattice& lattice, FixedVec centre_q8) {
    const std::int64_t area_q16 =
        std::max<std::int64_t>(cross(lattice.u_q16, lattice.v_q16) >> 16, 1);
    const auto entry = [&](std::int32_t a_q16) {
        return short_quotient(std::int64_t{a_q16} << 24, area_q16);
    };
    PlaneFromImage plane;
    plane.centre_q8 = centre_q8;
    plane.du_q24 = {entry(lattice.v_q16.y), entry(-lattice.u_q16.y)};
    plane.dv_q24 = {entry(-lattice.v_q16.x), entry(lattice.u_q16.x)};
    const FixedVec origin_q8{shift_rounded(lattice.origin_q16.x, 8),
                             shift_rounded(lattice.origin_q16.y, 8)};
    plane.at_centre_q16 = -linear_q16(plane, origin_q8 - centre_q8);
    return plane;
}

std::int64_t divisor_q30(const PlaneFromImage& plane, FixedVec from_centre_q8) {
    const std::int64_t tilt_q30 = dot(plane.perspective_q30, from_centre_q8) >> 8;
    const std::int64_t bend_q30 = bend_q48(plane.lens_q40, from_centre_q8) >> 18;
    return std::max(kOne_q30 + tilt_q30 + bend_q30, kOne_q30 / 4);
}

FixedVec plane_point_q16(const PlaneFromImage& plane, FixedVec image_point_q8) {
    const FixedVec p = image_point_q8 - plane.centre_q8;
    const FixedVec linear = linear_q16(plane, p);
    if (is_affine(plane)) return plane.at_centre_q16 + linear;
    return plane.at_centre_q16 + divided_q30(linear, divisor_q30(plane, p));
}

GridPoint grid_point(const PlaneFromImage& plane, FixedVec image_point_q8) {
    const FixedVec c = plane_point_q16(plane, image_point_q8);
    const FixedVec cell{(c.x + 32768) >> 16, (c.y + 32768) >> 16};
    return {cell, {c.x - cell.x * 65536, c.y - cell.y * 65536}};
}

FixedVec image_point_q8(const PlaneFromImage& plane, FixedVec plane_point) {
    // Maximum number of Newton steps. Each step uses the derivatives at the current point. For an
    // affine plane, one step is exact up to truncation.
    constexpr int kMaxRounds = 12;
    // Limit on the image coordinates, because the iteration may diverge where the map folds.
    constexpr std::int32_t kFarthest_q8 = 1 << 21;
    FixedVec point_q8 = plane.centre_q8;
    for (int round = 0; round < kMaxRounds; ++round) {
        const PlaneFromImage here = is_affine(plane) ? plane : tangent(plane, point_q8);
        const std::int64_t area_q32 =
            std::max<std::int64_t>(cross(here.du_q24, here.dv_q24) >> 16, 1);
        const FixedVec missing_q16 = plane_point - plane_point_q16(plane, point_q8);
        const auto quotient = [&](std::int64_t numerator_q40) {
            return limited(divide_rounded(numerator_q40, area_q32), kFarthest_q8);
        };
        const FixedVec step_q8{quotient(cross(missing_q16, here.dv_q24)),
                               quotient(cross(here.du_q24, missing_q16))};
        point_q8 = {limited(point_q8.x + step_q8.x, kFarthest_q8),
                    limited(point_q8.y + step_q8.y, kFarthest_q8)};
        if (step_q8 == FixedVec{}) break;
    }
    return point_q8;
}

PlaneFromImage affine_tangent(const PlaneFromImage& plane, FixedVec image_point_q8) {
    PlaneFromImage result = plane;
    result.centre_q8 = image_point_q8;
    result.at_centre_q16 =
        plane.at_centre_q16 + linear_q16(plane, image_point_q8 - plane.centre_q8);
    return result;
}

PlaneFromImage tangent(const PlaneFromImage& plane, FixedVec image_point_q8) {
    if (is_affine(plane)) return affine_tangent(plane, image_point_q8);
    PlaneFromImage result;
    result.centre_q8 = image_point_q8;
    result.at_centre_q16 = plane_point_q16(plane, image_point_q8);
    const FixedVec p = image_point_q8 - plane.centre_q8;
    const std::int64_t divisor = divisor_q30(plane, p);
    const FixedVec from_centre_q16 = result.at_centre_q16 - plane.at_centre_q16;
    // Uses the quotient rule. The derivative of the divisor is perspective + 2 lens (x, y).
    const auto slope = [&](FixedVec linear_q24, std::int32_t perspective_q30,
                           std::int32_t along_q8) {
        const std::int64_t bend_q30 = (std::int64_t{plane.lens_q40} * along_q8) >> 17;
        constexpr std::int64_t kSteepest_q30 = std::int64_t{1} << 31;
        const std::int64_t d_q30 =
            std::clamp(perspective_q30 + bend_q30, -kSteepest_q30, kSteepest_q30);
        const auto component = [&](std::int32_t a_q24, std::int32_t value_q16) {
            return limited(a_q24 - ((value_q16 * d_q30) >> 22), kBeyondReason);
        };
        return divided_q30({component(linear_q24.x, from_centre_q16.x),
                            component(linear_q24.y, from_centre_q16.y)},
                           divisor);
    };
    result.du_q24 = slope(plane.du_q24, plane.perspective_q30.x, p.x);
    result.dv_q24 = slope(plane.dv_q24, plane.perspective_q30.y, p.y);
    return result;
}

}  // namespace dotpose::core
