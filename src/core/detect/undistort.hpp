// Undistort: removes lens distortion from image points, or adds it (paper, equations 1-2).
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

FixedVec undistorted(const FixedLens& lens, FixedVec image_centre_q8, FixedVec point_q8);

/// Removes the distortion from the dot centres, in place.
void undistort(const FixedLens& lens, FixedVec image_centre_q8, std::span<DetectedDot> dots);

/// Adds the distortion to an undistorted image point: r_d = 2 r_u / (1 + sqrt(1 - 4 k r_u^2)). This
/// is the inverse of `undistorted` (paper, equation 2). If the point is so far from the distortion
/// centre that no image point corresponds to it, the root is replaced with 0.
FixedVec distorted(const FixedLens& lens, FixedVec image_centre_q8, FixedVec point_q8);

/// Maps a plane point to a distorted image point, in 2^-8 px. `plane.centre_q8` is used as the
/// image centre.
FixedVec distorted_point_q8(const FixedLens& lens, const PlaneFromImage& plane,
                            FixedVec plane_point_q16);

}  // namespace dotpose::core
