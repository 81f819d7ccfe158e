// Undistort: where a lens without distortion would have put the dots, and back. Paper eq. 1-2.
#pragma once

#include "core/stages.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Eq. 1-2.
Vec undistorted(const Lens& lens, Vec image_centre_q8, Vec point_q8);

void undistort(const Lens& lens, Vec image_centre_q8, std::span<Dot> dots);

/// The inverse of eq. 2: r_d = 2 r_u / (1 + sqrt(1 - 4 k r_u^2)).
Vec distorted(const Lens& lens, Vec image_centre_q8, Vec point_q8);

/// Where the image, whose centre is that of the plane, shows a point of the plane, in px.
Vec distorted_point_q8(const Lens& lens, const PlaneFromImage& plane, Vec plane_point_q16);

}  // namespace dotpose::core
