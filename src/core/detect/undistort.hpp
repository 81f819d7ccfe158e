// Undistort: moves dots to where a lens without distortion would have put them, and back. Paper eq.
// 1-2.
#pragma once

#include "core/stages.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Returns where a lens without distortion would put an image point, by eq. 1-2.
Vec undistorted(const Lens& lens, Vec image_centre_q8, Vec point_q8);

/// Moves dots to where a lens without distortion would have put them.
void undistort(const Lens& lens, Vec image_centre_q8, std::span<Dot> dots);

/// Returns where the lens puts an undistorted point, the inverse of eq. 2: r_d = 2 r_u / (1 +
/// sqrt(1 - 4 k r_u^2)).
Vec distorted(const Lens& lens, Vec image_centre_q8, Vec point_q8);

/// Returns where an image, whose centre is that of the plane, shows a point of the plane, in 2^-8
/// px.
Vec distorted_point_q8(const Lens& lens, const PlaneFromImage& plane, Vec plane_point_q16);

}  // namespace dotpose::core
