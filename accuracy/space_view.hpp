// Views of a tilted camera: frames, true poses in space, and the Cramer-Rao bound of these poses.
#pragma once

#include <Eigen/Core>

#include "dotpose/tools/simulate.hpp"
#include "dotpose/tools/space_pose.hpp"

namespace dotpose::tables {

/// Position in mm in the pattern frame, and rotation from the camera to the pattern.
struct TrueSpacePose {
    Eigen::Vector3d position_mm;
    Eigen::Matrix3d rotation;
};

/// Returns the true pose of a shot, from the definitions in simulate.hpp.
TrueSpacePose true_space_pose(const Shot& shot);

/// Returns the camera file of a simulated camera, with its true lens and focal length.
Camera space_camera(const CameraModel& model);

using SpaceVector = Eigen::Matrix<double, 6, 1>;
using SpaceMatrix = Eigen::Matrix<double, 6, 6>;

/// Returns the error of a pose, in the coordinates of SpacePose::covariance.
SpaceVector space_error(const CameraInSpace& camera, const TrueSpacePose& truth);

/// Minimum spacing in the image, in px, in the direction in which it is shortest. Below this
/// spacing, the images of adjacent dots overlap.
inline constexpr double kResolvedSpacing_px = 4;

/// Returns the Cramer-Rao bound of the covariance of a pose, from all dots that are completely in
/// view and whose images do not overlap. `jitter_mm` is the standard deviation of the printing
/// error along each axis. The bound includes the noise of the image, but not the motion during the
/// exposure.
SpaceMatrix space_bound(const Shot& shot, double jitter_mm);

}  // namespace dotpose::tables
