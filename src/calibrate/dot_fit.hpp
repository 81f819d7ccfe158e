// Dot fit: least squares over the dots of one frame, without outliers.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace dotpose::calibrate {

/// An equation of one dot along one axis: row . parameters = wanted. A fit with fewer parameters
/// does not use the last coefficients.
struct AxisEquation {
    std::array<double, 7> row{};
    double wanted = 0;
};
/// The equations of one dot along both axes.
using DotEquation = std::array<AxisEquation, 2>;

/// The result of a fit.
struct DotFit {
    std::vector<double> parameters;
    Eigen::MatrixXd covariance;
    double variance = 0;  ///< variance of a dot along one axis
    int dots = 0;         ///< number of dots used
};

/// Fits all dots except those more than four standard deviations off.
DotFit fit_dots(const std::vector<DotEquation>& dots, int parameters);

}  // namespace dotpose::calibrate
