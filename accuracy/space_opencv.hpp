// Computes poses in space with OpenCV, for comparison.
#pragma once

#include "calibrate/space_fit.hpp"

namespace dotpose::tables {

/// Returns the pose that OpenCV computes from the dots and the fitted dot displacement in `fit`.
/// The pose is the better of the two poses returned by cv::solvePnPGeneric with SOLVEPNP_IPPE,
/// refined by cv::solvePnPRefineLM.
calibrate::SpaceState opencv_pose(const calibrate::SpaceFit& fit, double focal_px);

}  // namespace dotpose::tables
