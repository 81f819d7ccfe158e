// Least squares: normal equations, and operations on covariances. Decompositions and products of
// matrices take long to compile, so least_squares.cpp contains those of the whole layer.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace dotpose::calibrate {

/// A linear least-squares problem: the sum of its equations row . parameters = wanted.
class NormalEquations {
  public:
    explicit NormalEquations(int parameters);

    /// Adds an equation. `row` has one coefficient per parameter.
    void add(std::span<const double> row, double wanted);
    /// Adds the equation parameter = 0, with a weight of its square.
    void pull_to_zero(int parameter, double weight);

    /// Returns the parameters with the smallest sum of squared residuals.
    std::vector<double> solution() const;
    /// Returns by how much the solution decreases the sum of squared residuals, compared with all
    /// parameters 0.
    double explained_squares() const;
    /// Returns the covariance of the solution if each wanted value has variance 1.
    Eigen::MatrixXd unit_covariance() const;

  private:
    Eigen::MatrixXd normal_;  ///< lower triangle
    Eigen::VectorXd right_;
};

/// Returns the inverse of a symmetric, positive definite matrix, of which only the lower triangle
/// is read. Rows may differ in scale by orders of magnitude.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& symmetric);

/// Returns the matrix that scales errors with this covariance to independent errors of variance 1.
/// It is lower triangular.
Eigen::MatrixXd whitening_of(const Eigen::MatrixXd& covariance);

/// Returns the covariance of values that are linear in parameters of known covariance: derivative *
/// covariance * derivative^T.
Eigen::MatrixXd propagated(const Eigen::MatrixXd& derivative, const Eigen::MatrixXd& covariance);

}  // namespace dotpose::calibrate
