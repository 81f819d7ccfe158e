// Undistort: conversion of image points to those of a lens without distortion, and back. Paper eq.
// 1-2.
#pragma once

#include "core/stages.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Returns the image point that a lens without distortion would give, by eq. 1-2.
Vec undistorted(const Lens& lens, Vec image_centre_q8, Vec point_q8);

/// Replaces the centres of dots by their undistorted points.
void undistort(const Lens& lens, Vec image_centre_q8, std::span<Dot> dots);

/// Returns the distorted image point of an undistorted one, by the inverse of eq. 2: r_d = 2 r_u /
/// (1 + sqrt(1 - 4 k r_u^2)).
Vec distorted(const Lens& lens, Vec image_centre_q8, Vec point_q8);

/// Returns the distorted image point of a plane point, in 2^-8 px. The centre of the plane is the
/// image centre.
Vec distorted_point_q8(const Lens& lens, const PlaneFromImage& plane, Vec plane_point_q16);

}  // namespace dotpose::core
