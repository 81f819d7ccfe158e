// Views of a tilted camera: frames, true poses in space, and the Cramer-Rao bound of these poses.
#pragma once

#include <Eigen/Core>

#include "dotpose/tools/simulate.hpp"
#include "dotpose/tools/space_pose.hpp"

namespace dotpose::tables {

/// Position in mm in the pattern frame, and camera-to-pattern rotation.
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

/// Spacing in the image, along the direction in which it is shortest, below which the images of
/// adjacent dots are not separate.
inline constexpr double kResolvedSpacing_px = 4;

/// Returns the Cramer-Rao bound for the covariance of a pose, from all dots that are completely in
/// view and separate in the image, for errors of the print with the standard deviation `jitter_mm`
/// along each axis, and for the noise of the image. Motion during the exposure is ignored.
SpaceMatrix space_bound(const Shot& shot, double jitter_mm);

}  // namespace dotpose::tables
