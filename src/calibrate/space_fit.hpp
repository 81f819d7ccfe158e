// Computes the maximum-likelihood pose of a camera above a plane of dots. If the pose is ambiguous,
// also computes a second solution.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace dotpose::calibrate {

/// A dot: its place on the paper and its measured image point.
struct SpaceDot {
    /// Undistorted image point relative to the principal point, in px.
    Eigen::Vector2d pixel;
    Eigen::Vector2d intersection_mm;  ///< position of the dot's intersection on the paper
    Eigen::Vector2d direction_mm;  ///< offset from the intersection for a displacement of 1 spacing
    /// Covariance of the measured image point, up to a factor common to all dots.
    Eigen::Matrix2d centre_covariance = Eigen::Matrix2d::Identity();
};

/// Position and rotation of a camera: X_paper = rotation * X_camera + position. The paper is the
/// plane z = 0, and z points away from the camera.
struct SpaceState {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
    /// Displacement of the dots from their intersections, in spacings.
    double displacement = 1.0 / 6;
};

struct SpaceFit {
    SpaceState state;
    /// Covariance of position_mm and of the rotation vector in the camera frame: true rotation =
    /// rotation * exp(vector).
    Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
    std::vector<SpaceDot> used;  ///< dots that are not outliers
    /// For each dot in `used`, the pose shift caused by its residual, in the same coordinates as
    /// `covariance`. These shifts determine how the errors of frames that show the same dots are
    /// correlated.
    std::vector<Eigen::Matrix<double, 6, 1>> influences;
    double residual_px = 0;  ///< rms residual of the dots in `used`, per axis
    std::optional<SpaceState> second;
    double second_odds_log2 = 0;
};

/// Fits the pose of a camera with the given focal lengths in px. Returns nullopt if the dots do not
/// determine a pose.
std::optional<SpaceFit> fit_space(const std::vector<SpaceDot>& dots,
                                  const Eigen::Vector2d& focal_px);

}  // namespace dotpose::calibrate
