// Tracked pose: the map from the image to the pattern of a tracked frame, in integers.
#pragma once

#include "core/stages.hpp"

namespace dotpose::core {

/// Lays the cells to where the dots that were read are, and tells the map from that, and how far
/// dots are displaced. Returns how many dots that were; 0 if they do not tell.
int fit_tracked_pose(const Tracking& tracking, PlaneFromImage& pattern_from_image,
                     std::int32_t& displacement_q16);

}  // namespace dotpose::core
