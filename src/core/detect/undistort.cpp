#include "core/detect/undistort.hpp"

#include "core/math/plane.hpp"

namespace dotpose::core {
namespace {

FixedVec centre_of(const FixedLens& lens, FixedVec image_centre_q8) {
    return image_centre_q8 + FixedVec{lens.centre_dx_q8, lens.centre_dy_q8};
}

}  // namespace

FixedVec undistorted(const FixedLens& lens, FixedVec image_centre_q8, FixedVec point_q8) {
    const FixedVec centre_q8 = centre_of(lens, image_centre_q8);
    // Offset from the distortion centre (paper, equation 1).
    const FixedVec r_d = point_q8 - centre_q8;
    const std::int64_t stretch_q30 = kOne_q30 + (bend_q48(lens.k_q40, r_d) >> 18);
    return centre_q8 + divided_q30(r_d, std::max(stretch_q30, kOne_q30 / 4));  // paper, equation 2
}

void undistort(const FixedLens& lens, FixedVec image_centre_q8, std::span<DetectedDot> dots) {
    if (lens.k_q40 == 0) return;
    for (DetectedDot& dot : dots)
        dot.centre_q8 = undistorted(lens, image_centre_q8, dot.centre_q8);
}

FixedVec distorted(const FixedLens& lens, FixedVec image_centre_q8, FixedVec point_q8) {
    if (lens.k_q40 == 0) return point_q8;
    const FixedVec centre_q8 = centre_of(lens, image_centre_q8);
    const FixedVec r_u = point_q8 - centre_q8;
    // A negative radicand means that there is no distorted point, and is replaced with 0. The upper
    // limit prevents an overflow in the next shift.
    const std::int64_t radicand_q30 = std::clamp<std::int64_t>(
        kOne_q30 - (bend_q48(lens.k_q40, r_u) >> 16), 0, 16 * kOne_q30 - 1);
    const std::int64_t root_q30 = square_root(static_cast<std::uint64_t>(radicand_q30) << 30);
    return centre_q8 + divided_q30(r_u, (kOne_q30 + root_q30) / 2);
}

FixedVec distorted_point_q8(const FixedLens& lens, const PlaneFromImage& plane,
                            FixedVec plane_point_q16) {
    return distorted(lens, plane.centre_q8, image_point_q8(plane, plane_point_q16));
}

}  // namespace dotpose::core
