// Plane: converts points between the image and the plane of the paper.
#pragma once

#include "core/math/fixed.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// A point in grid coordinates: the nearest intersection and the offset from this intersection.
struct GridPoint {
    FixedVec cell;        ///< nearest intersection (paper, equation 4)
    FixedVec offset_q16;  ///< in spacings, each component in [-1/2, 1/2) (paper, equation 5)
};

/// Maximum magnitude of coordinates in 2^-16 spacings, and of slopes in 2^-24 spacings per px.
/// Larger values, which occur only in planes fitted to false dots, are clamped. Four times the
/// maximum fits in 32 bits.
inline constexpr std::int32_t kBeyondReason = 1 << 28;

/// Returns k |r|^2 in units of 2^-48, for an offset r from the distortion centre. On steeply tilted
/// planes, projected points may be far away, so |r| is clamped to 4096 px. The result then fits in
/// 64 bits for any k.
inline std::int64_t bend_q48(std::int32_t k_q40, FixedVec r_q8) {
    constexpr std::int64_t kFarthest_q8 = 0xFFFFFFFF;
    return k_q40 * std::min(squared(r_q8) >> 8, kFarthest_q8);
}

/// Returns true if the plane is affine: it has neither perspective nor a lens term.
inline bool is_affine(const PlaneFromImage& plane) {
    return plane.perspective_q30 == FixedVec{} && plane.lens_q40 == 0;
}

/// Returns the affine plane that maps image points to lattice coordinates. Requires u x v > 0.
PlaneFromImage plane_from_lattice(const Lattice& lattice, FixedVec centre_q8);

/// Maps an image point to the plane, in 2^-16 spacings (paper, equation 3). Unlike the paper, which
/// projects the point onto u and v, this function uses the inverse of the matrix (u, v). The
/// projection is correct only for perpendicular axes and a camera without tilt.
FixedVec plane_point_q16(const PlaneFromImage& plane, FixedVec image_point_q8);

/// Returns the intersection nearest to an image point, and the point's offset from this
/// intersection (paper, equations 3-5).
GridPoint grid_point(const PlaneFromImage& plane, FixedVec image_point_q8);

/// Maps a plane point to the image, in 2^-8 px. This is the inverse of `plane_point_q16`. The
/// result may be wrong where the map folds. Its coordinates are at most 2^21 in magnitude.
FixedVec image_point_q8(const PlaneFromImage& plane, FixedVec plane_point_q16);

/// Returns the linear approximation of a plane at an image point: the affine plane with the same
/// value and derivatives at this point.
PlaneFromImage tangent(const PlaneFromImage& plane, FixedVec image_point_q8);

/// Variant of `tangent` for an affine plane.
PlaneFromImage affine_tangent(const PlaneFromImage& plane, FixedVec image_point_q8);

/// Returns the divisor in the map from image to plane: 1 + perspective . (x, y) + lens (x^2 + y^2),
/// but at least 1/4. (x, y) is the offset from the plane centre.
std::int64_t divisor_q30(const PlaneFromImage& plane, FixedVec from_centre_q8);

}  // namespace dotpose::core
