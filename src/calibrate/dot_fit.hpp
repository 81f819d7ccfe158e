// Dot fit: least squares over the dots of one frame, without outliers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace dotpose::calibrate {

/// The equation of one dot along both axes: rows * parameters = wanted.
template <int kSize>
struct DotEquation {
    Eigen::Matrix<double, 2, kSize> rows;
    Eigen::Vector2d wanted;
};

/// The result of a fit.
template <int kSize>
struct DotFit {
    Eigen::Matrix<double, kSize, 1> parameters = Eigen::Matrix<double, kSize, 1>::Zero();
    Eigen::Matrix<double, kSize, kSize> covariance = Eigen::Matrix<double, kSize, kSize>::Zero();
    double variance = 0;  ///< variance of a dot along one axis
    int dots = 0;         ///< number of dots used
};

/// Fits the dots whose squared residual in the last fit is at most `limit`.
template <int kSize>
DotFit<kSize> fit_near_dots(const std::vector<DotEquation<kSize>>& dots, double limit,
                            const DotFit<kSize>& last) {
    DotFit<kSize> fit;
    Eigen::Matrix<double, kSize, kSize> normal = Eigen::Matrix<double, kSize, kSize>::Zero();
    Eigen::Matrix<double, kSize, 1> right = Eigen::Matrix<double, kSize, 1>::Zero();
    double squares = 0;
    for (const auto& dot : dots) {
        if ((dot.rows * last.parameters - dot.wanted).squaredNorm() > limit) continue;
        normal += dot.rows.transpose() * dot.rows;
        right += dot.rows.transpose() * dot.wanted;
        squares += dot.wanted.squaredNorm();
        ++fit.dots;
    }
    const Eigen::LDLT<Eigen::Matrix<double, kSize, kSize>> solver(normal);
    fit.parameters = solver.solve(right);
    const double left = std::max(squares - right.dot(fit.parameters), 0.0);
    fit.variance = left / std::max(2 * fit.dots - kSize, 1);
    fit.covariance = fit.variance * solver.solve(Eigen::Matrix<double, kSize, kSize>::Identity());
    return fit;
}

/// Fits all dots except those more than four standard deviations off.
template <int kSize>
DotFit<kSize> fit_dots(const std::vector<DotEquation<kSize>>& dots) {
    constexpr int kRounds = 3;
    constexpr double kOutlier_sigmas = 4;
    DotFit<kSize> fit;
    double limit = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kRounds; ++round) {
        fit = fit_near_dots(dots, limit, fit);
        std::vector<double> squares;
        for (const auto& dot : dots)
            squares.push_back((dot.rows * fit.parameters - dot.wanted).squaredNorm());
        const auto median = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
        std::ranges::nth_element(squares, median);
        // The median of the squared distances of a plane Gaussian is 1.39 sigma^2.
        limit = kOutlier_sigmas * kOutlier_sigmas * *median / 1.386;
    }
    return fit;
}

}  // namespace dotpose::calibrate
