// Covariances of problems that share a few parameters among many poses.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <ceres/problem.h>

namespace dotpose::calibrate {

/// The block of (J^T J)^-1 that belongs to the shared blocks of parameters, in their order. No
/// residual may depend on more than one of the other blocks. Of these problems ceres::Covariance
/// would take a minute.
Eigen::MatrixXd normal_inverse(ceres::Problem& problem, const std::vector<double*>& shared);

/// By how much the shared blocks' best values move with each residual, those in the order in which
/// they were added: times its transpose it is the matrix above.
Eigen::MatrixXd normal_gain(ceres::Problem& problem, const std::vector<double*>& shared);

}  // namespace dotpose::calibrate
