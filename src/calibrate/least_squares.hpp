// Normal equations for linear least squares, and operations on covariances. Matrix decompositions
// and products that several files use are implemented in least_squares.cpp, because they are slow
// to compile.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace dotpose::calibrate {

/// Linear least-squares problem: a set of equations row . parameters = wanted.
class NormalEquations {
  public:
    explicit NormalEquations(int parameters);

    /// Adds an equation. `row` contains one coefficient per parameter.
    void add(std::span<const double> row, double wanted);
    /// Adds the equation parameter = 0. The square of its residual is multiplied by `weight`.
    void pull_to_zero(int parameter, double weight);

    /// Returns the parameters with the smallest sum of squared residuals.
    std::vector<double> solution() const;
    /// Returns the sum of squared residuals with all parameters set to 0, minus the sum at the
    /// solution.
    double explained_squares() const;
    /// Returns the covariance of the solution, assuming that each `wanted` value has variance 1.
    Eigen::MatrixXd unit_covariance() const;

  private:
    Eigen::MatrixXd normal_;  ///< lower triangle
    Eigen::VectorXd right_;
};

/// Returns the inverse of a symmetric, positive definite matrix. Only the lower triangle is read.
/// The scales of the rows may differ by orders of magnitude.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& symmetric);

/// Returns the lower triangular matrix that transforms errors with this covariance into independent
/// errors with variance 1.
Eigen::MatrixXd whitening_of(const Eigen::MatrixXd& covariance);

/// Returns the covariance of linear functions of parameters with known covariance: derivative *
/// covariance * derivative^T.
Eigen::MatrixXd propagated(const Eigen::MatrixXd& derivative, const Eigen::MatrixXd& covariance);

}  // namespace dotpose::calibrate
