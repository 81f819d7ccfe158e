// Points between the image and the plane of the paper.
#pragma once

#include "core/math/fixed.hpp"
#include "core/stages.hpp"

namespace dotpose::core {

/// A point of the grid: the nearest intersection and the offset from it.
struct GridPoint {
    Vec cell;        ///< paper eq. 4
    Vec offset_q16;  ///< eq. 5, in spacings, each in [-1/2, 1/2)
};

/// More spacings, in 2^-16, than any image shows, and more of them, in 2^-24, than there are in a
/// pixel. Planes fitted to dots that are none may have more; four times as much has 32 bits.
inline constexpr std::int32_t kBeyondReason = 1 << 28;

/// k r^2. Beyond 4096 px, where hardly an image reaches but a plane seen from the side does, as
/// much as there: with any k this has 64 bits.
inline std::int64_t bend_q48(std::int32_t k_q40, Vec r_q8) {
    constexpr std::int64_t kFarthest_q8 = 0xFFFFFFFF;
    return k_q40 * std::min(squared(r_q8) >> 8, kFarthest_q8);
}

/// Whether a plane is without perspective and lens.
inline bool is_affine(const PlaneFromImage& plane) {
    return plane.perspective_q30 == Vec{} && plane.lens_q40 == 0;
}

/// A plane without perspective or lens. |u x v| > 0.
PlaneFromImage plane_from_lattice(const Lattice& lattice, Vec centre_q8);

/// Eq. 3. differs: the paper projects on u and v, which is right only where these stand at right
/// angles and the camera is not tilted.
Vec plane_point_q16(const PlaneFromImage& plane, Vec image_point_q8);

/// Eq. 3-5.
GridPoint grid_point(const PlaneFromImage& plane, Vec image_point_q8);

/// The inverse of plane_point_q16, in px.
Vec image_point_q8(const PlaneFromImage& plane, Vec plane_point_q16);

/// How the plane lies around one image point: without perspective or lens, the same there in value
/// and slope.
PlaneFromImage tangent(const PlaneFromImage& plane, Vec image_point_q8);

/// The same of a plane that is without perspective and lens anyway.
PlaneFromImage affine_tangent(const PlaneFromImage& plane, Vec image_point_q8);

/// The divisor 1 + perspective . (x, y) + lens (x^2 + y^2), at least 1/4.
std::int64_t divisor_q30(const PlaneFromImage& plane, Vec from_centre_q8);

}  // namespace dotpose::core
