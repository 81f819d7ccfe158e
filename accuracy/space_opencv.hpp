// Poses in space by OpenCV, for comparison.
#pragma once

#include "dotpose/tools/space_pose.hpp"

namespace dotpose::tables {

/// Returns the better of the two poses of cv::solvePnPGeneric with SOLVEPNP_IPPE, refined by
/// cv::solvePnPRefineLM, from the dots in the trace.
CameraInSpace opencv_pose(const Fix& fix, const Camera& camera, const Trace& trace);

}  // namespace dotpose::tables
