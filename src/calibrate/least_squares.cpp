#include "calibrate/least_squares.hpp"

#include <Eigen/Cholesky>

namespace dotpose::calibrate {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

NormalEquations::NormalEquations(int parameters)
    : normal_(MatrixXd::Zero(parameters, parameters)), right_(VectorXd::Zero(parameters)) {}

void NormalEquations::add(std::span<const double> row, double wanted) {
    const Eigen::Map<const VectorXd> values(row.data(), right_.size());
    for (Index i = 0; i < right_.size(); ++i) {
        right_[i] += values[i] * wanted;
        for (Index j = i; j < right_.size(); ++j)
            normal_(j, i) += values[j] * values[i];
    }
}

void NormalEquations::pull_to_zero(int parameter, double weight) {
    normal_(parameter, parameter) += weight;
}

std::vector<double> NormalEquations::solution() const {
    const VectorXd solution = normal_.ldlt().solve(right_);
    return {solution.data(), solution.data() + solution.size()};
}

double NormalEquations::explained_squares() const {
    return right_.dot(normal_.ldlt().solve(right_));
}

MatrixXd NormalEquations::unit_covariance() const {
    return inverse_of(normal_);
}

MatrixXd inverse_of(const MatrixXd& symmetric) {
    const VectorXd scale = symmetric.diagonal().cwiseSqrt().cwiseMax(1e-30).cwiseInverse();
    const MatrixXd scaled = scale.asDiagonal() * symmetric * scale.asDiagonal();
    const MatrixXd inverse =
        scaled.ldlt().solve(MatrixXd::Identity(symmetric.rows(), symmetric.cols()));
    return scale.asDiagonal() * inverse * scale.asDiagonal();
}

MatrixXd whitening_of(const MatrixXd& covariance) {
    const Index size = covariance.rows();
    return covariance.llt().matrixL().solve(MatrixXd::Identity(size, size));
}

MatrixXd propagated(const MatrixXd& derivative, const MatrixXd& covariance) {
    return derivative * covariance * derivative.transpose();
}

}  // namespace dotpose::calibrate
