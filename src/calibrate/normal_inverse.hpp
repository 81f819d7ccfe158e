// Normal inverse: covariances of problems that share a few parameters among many poses.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <ceres/problem.h>

namespace dotpose::calibrate {

/// Returns the block of (J^T J)^-1 that belongs to the shared blocks of parameters, in their order.
/// No residual may depend on more than one of the other blocks. ceres::Covariance would take a
/// minute for these problems.
Eigen::MatrixXd normal_inverse(ceres::Problem& problem, const std::vector<double*>& shared);

/// Returns how much the best values of the shared blocks change with each residual, in the order in
/// which residuals were added. This matrix times its transpose is `normal_inverse`.
Eigen::MatrixXd normal_gain(ceres::Problem& problem, const std::vector<double*>& shared);

}  // namespace dotpose::calibrate
