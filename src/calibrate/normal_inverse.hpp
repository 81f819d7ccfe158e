// Normal inverse: covariances for problems with a few parameters that many poses share.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <ceres/problem.h>

namespace dotpose::calibrate {

/// Returns the block of (J^T J)^-1 for the shared parameter blocks, in the order of `shared`. A
/// residual may depend on at most one block that is not shared. ceres::Covariance is not used
/// because it needs about a minute for such problems.
Eigen::MatrixXd normal_inverse(ceres::Problem& problem, const std::vector<double*>& shared);

/// Returns the derivative of the solution for the shared blocks with respect to the residuals, in
/// the order in which the residuals were added. This matrix times its transpose is
/// `normal_inverse`.
Eigen::MatrixXd normal_gain(ceres::Problem& problem, const std::vector<double*>& shared);

}  // namespace dotpose::calibrate
