// Undistort: where a lens without distortion would have put the dots. Paper eq. 1-2.
#pragma once

#include "dotpose/options.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

void undistort(const Lens& lens, Vec image_centre_q8, std::span<Dot> dots);

}  // namespace dotpose::core
