// Least-squares fit to the dots in one frame, with rejection of outliers.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace dotpose::calibrate {

/// Equation for one axis of one dot: row . parameters = wanted. A fit with n parameters uses only
/// the first n coefficients of `row`.
struct AxisEquation {
    std::array<double, 8> row{};
    double wanted = 0;
};
/// Equations for both axes of one dot.
using DotEquation = std::array<AxisEquation, 2>;

struct DotFit {
    std::vector<double> parameters;
    Eigen::MatrixXd covariance;
    double variance = 0;  ///< variance of the residuals of the dots, per axis
    int dots = 0;         ///< number of dots used
};

/// Fits the equations of all dots whose residuals are below four standard deviations.
DotFit fit_dots(const std::vector<DotEquation>& dots, int parameters);

}  // namespace dotpose::calibrate
