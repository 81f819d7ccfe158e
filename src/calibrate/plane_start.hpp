// Computes the two poses of a camera that explain the image of a small plane.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "calibrate/space_fit.hpp"

namespace dotpose::calibrate {

/// Returns the two poses whose projections agree with the homography of the dots, to first order,
/// at the middle of the dots. The method is infinitesimal plane-based pose estimation (T. Collins
/// and A. Bartoli, International Journal of Computer Vision 109, 2014). Returns nullopt if the dots
/// do not determine a homography.
std::optional<std::array<SpaceState, 2>> plane_starts(const std::vector<SpaceDot>& dots,
                                                      const Eigen::Vector2d& focal_px);

}  // namespace dotpose::calibrate
