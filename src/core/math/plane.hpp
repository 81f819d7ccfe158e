// Plane: conversion of points between the image and the plane of the paper.
#pragma once

#include "core/math/fixed.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// A point in grid coordinates: the nearest intersection and the offset from this intersection.
struct GridPoint {
    FixedVec cell;        ///< paper eq. 4
    FixedVec offset_q16;  ///< eq. 5, in spacings, each in [-1/2, 1/2)
};

/// Limit of coordinates, in units of 2^-16 spacings, and of slopes, in units of 2^-24 spacings per
/// px. Planes of real images are within the limit, but planes fitted to false dots may exceed the
/// limit. Four times the limit fits in 32 bits.
inline constexpr std::int32_t kBeyondReason = 1 << 28;

/// Returns k r^2 in units of 2^-48, with r clamped to 4096 px. With this limit, the result fits in
/// 64 bits for any k. Points of images are rarely farther from the centre, but projected points of
/// steeply tilted planes may be.
inline std::int64_t bend_q48(std::int32_t k_q40, FixedVec r_q8) {
    constexpr std::int64_t kFarthest_q8 = 0xFFFFFFFF;
    return k_q40 * std::min(squared(r_q8) >> 8, kFarthest_q8);
}

/// Returns true if a plane has neither perspective nor a lens term.
inline bool is_affine(const PlaneFromImage& plane) {
    return plane.perspective_q30 == FixedVec{} && plane.lens_q40 == 0;
}

/// Returns the plane, without perspective or lens term, that maps image points to the coordinates
/// of a lattice. Requires u x v > 0.
PlaneFromImage plane_from_lattice(const Lattice& lattice, FixedVec centre_q8);

/// Returns the plane point of an image point by eq. 3, in units of 2^-16 spacings. Differs: the
/// paper projects the point onto u and v, which is correct only if u and v are at right angles and
/// the camera is not tilted.
FixedVec plane_point_q16(const PlaneFromImage& plane, FixedVec image_point_q8);

/// Returns the intersection nearest to an image point, and the offset of the point from this
/// intersection, by eq. 3-5.
GridPoint grid_point(const PlaneFromImage& plane, FixedVec image_point_q8);

/// Returns the image point of a plane point, in units of 2^-8 px: the inverse of `plane_point_q16`.
/// Where the map folds, the result may be wrong, but the magnitude of its coordinates is at most
/// 2^21.
FixedVec image_point_q8(const PlaneFromImage& plane, FixedVec plane_point_q16);

/// Returns the tangent of the plane at an image point: the plane without perspective or lens term
/// that has the same value and slope at this point.
PlaneFromImage tangent(const PlaneFromImage& plane, FixedVec image_point_q8);

/// Variant of `tangent` for a plane that has neither perspective nor a lens term.
PlaneFromImage affine_tangent(const PlaneFromImage& plane, FixedVec image_point_q8);

/// Returns the divisor 1 + perspective . (x, y) + lens (x^2 + y^2), at least 1/4.
std::int64_t divisor_q30(const PlaneFromImage& plane, FixedVec from_centre_q8);

}  // namespace dotpose::core
