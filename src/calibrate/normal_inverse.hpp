// Covariances for problems in which many poses share a few parameters.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <ceres/problem.h>

namespace dotpose::calibrate {

/// Returns the block of (J^T J)^-1 for the shared parameter blocks, in the order of `shared`. J is
/// the Jacobian of all residuals. A residual may depend on at most one unshared block.
/// ceres::Covariance is not used because it takes about a minute for these problems.
Eigen::MatrixXd normal_inverse(ceres::Problem& problem, const std::vector<double*>& shared);

/// Returns the derivative of the solution for the shared blocks with respect to the residuals. The
/// columns are in the order in which the residuals were added. The product of this matrix and its
/// transpose is `normal_inverse`.
Eigen::MatrixXd normal_gain(ceres::Problem& problem, const std::vector<double*>& shared);

}  // namespace dotpose::calibrate
