// Undistort: converts image points between a lens with distortion and a lens without distortion.
// Paper eq. 1-2.
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Returns the undistorted image point of an image point, by eq. 1-2.
FixedVec undistorted(const FixedLens& lens, FixedVec image_centre_q8, FixedVec point_q8);

/// Replaces the centres of dots with the undistorted image points.
void undistort(const FixedLens& lens, FixedVec image_centre_q8, std::span<DetectedDot> dots);

/// Returns the distorted image point of an undistorted image point, by the inverse of eq. 2: r_d =
/// 2 r_u / (1 + sqrt(1 - 4 k r_u^2)).
FixedVec distorted(const FixedLens& lens, FixedVec image_centre_q8, FixedVec point_q8);

/// Returns the distorted image point of a plane point, in units of 2^-8 px. The centre of the plane
/// is the image centre.
FixedVec distorted_point_q8(const FixedLens& lens, const PlaneFromImage& plane,
                            FixedVec plane_point_q16);

}  // namespace dotpose::core
