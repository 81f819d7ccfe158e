// Tracked pose: the pose from the dots of a tracked frame, in integers.
#pragma once

#include <span>

#include "dotpose/stages.hpp"

namespace dotpose::core {

/// Least squares as in affine_pose.hpp, from all dots. Returns the number of dots used; 0 when they
/// do not determine the pose. `displacement_q16`: of the typical dot from its intersection,
/// spacings.
int fit_tracked_pose(std::span<const Dot> dots, const Tracking& tracking,
                     PlaneFromImage& pattern_from_image, std::int32_t& displacement_q16);

}  // namespace dotpose::core
