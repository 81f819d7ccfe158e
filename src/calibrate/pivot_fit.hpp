// Finds the pivot point of a device, such as the tip of a pen, from views in which the device turns
// about this point.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace dotpose::calibrate {

/// Shift of a pose caused by the residual of one dot.
struct DotInfluence {
    std::uint64_t dot = 0;  ///< identifies the dot in all frames
    Eigen::Matrix<double, 6, 1> shift;
};

/// Pose of the camera in one frame: X_paper = rotation * X_camera + position.
struct PivotView {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d position_mm;
    /// Covariance of the position and of a small rotation vector in the camera frame.
    Eigen::Matrix<double, 6, 6> covariance;
    std::vector<DotInfluence> influences;
};

struct PivotFit {
    Eigen::Vector3d tip_mm;   ///< tip in the camera frame
    Eigen::Vector3d rest_mm;  ///< resting point on the paper, in the frame of the views
    /// Covariance of the tip and of the resting point. Frames that show the same dots have
    /// correlated errors, because the printing errors of these dots shift all poses. The covariance
    /// is therefore computed from the residuals of each dot in all frames. The covariance is
    /// increased if the tip moved more than the pose errors can explain.
    Eigen::Matrix<double, 6, 6> covariance;
    std::vector<bool> is_used;  ///< indexed by view
    double residual_mm = 0;     ///< rms residual per axis
    double error_ratio = 1;  ///< rms residual, relative to the value expected from the pose errors
};

/// Returns the minimum, over all axes fixed to the camera, of the rms change in the direction of
/// the axis between the views, in rad. The result is 0 if all rotations are about the same axis. In
/// that case, the position of the tip along this axis is not determined.
double pivot_angle_rad(const std::vector<PivotView>& views);

/// Fits the tip by weighted least squares. Views that contradict the majority are not used.
/// pivot_angle_rad(views) must be positive.
PivotFit fit_pivot(const std::vector<PivotView>& views);

}  // namespace dotpose::calibrate
