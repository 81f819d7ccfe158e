// Tracked pose: the map from the image to the pattern of a tracked frame, in integers.
#pragma once

#include "core/stages.hpp"

namespace dotpose::core {

/// Fits the cells to the dots that were read, and sets the map and the typical displacement of dots
/// in spacings. Returns the number of dots, or 0 if they do not determine the map.
int fit_tracked_pose(const Tracking& tracking, PlaneFromImage& pattern_from_image,
                     std::int32_t& displacement_q16);

}  // namespace dotpose::core
