#include "calibrate/dot_fit.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "calibrate/least_squares.hpp"
#include "calibrate/median.hpp"

namespace dotpose::calibrate {
namespace {

double squared_residual(const DotEquation& dot, const std::vector<double>& parameters) {
    double squares = 0;
    for (const AxisEquation& axis : dot) {
        const double residual = std::inner_product(parameters.begin(), parameters.end(),
                                                   axis.row.begin(), -axis.wanted);
        squares += residual * residual;
    }
    return squares;
}

/// Fits the dots whose squared residuals in the previous fit are at most `limit`.
DotFit fit_near_dots(const std::vector<DotEquation>& dots, double limit, const DotFit& last) {
    const std::size_t parameters = last.parameters.size();
    NormalEquations equations(static_cast<int>(parameters));
    DotFit fit;
    double squares = 0;
    for (const DotEquation& dot : dots) {
        if (squared_residual(dot, last.parameters) > limit) continue;
        for (const AxisEquation& axis : dot) {
            equations.add(std::span(axis.row).first(parameters), axis.wanted);
            squares += axis.wanted * axis.wanted;
        }
        ++fit.dots;
    }
    fit.parameters = equations.solution();
    const double left = std::max(squares - equations.explained_squares(), 0.0);
    fit.variance = left / std::max(2 * fit.dots - static_cast<int>(parameters), 1);
    fit.covariance = fit.variance * equations.unit_covariance();
    return fit;
}

}  // namespace

DotFit fit_dots(const std::vector<DotEquation>& dots, int parameters) {
    constexpr int kRounds = 3;
    constexpr double kOutlier_sigmas = 4;
    DotFit fit;
    fit.parameters.resize(static_cast<std::size_t>(parameters));
    double limit = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kRounds; ++round) {
        fit = fit_near_dots(dots, limit, fit);
        std::vector<double> squares;
        for (const DotEquation& dot : dots)
            squares.push_back(squared_residual(dot, fit.parameters));
        limit = kOutlier_sigmas * kOutlier_sigmas * upper_median(std::move(squares)) /
                kMedianOfSquaredLength;
    }
    return fit;
}

}  // namespace dotpose::calibrate
