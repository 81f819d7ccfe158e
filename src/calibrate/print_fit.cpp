#include "calibrate/print_fit.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

namespace dotpose::calibrate {
namespace {

using Eigen::Vector2d;

constexpr int kRounds = 2;
constexpr int kSteps = 6;
constexpr double kOutlier_sigmas = 4;
using Parameters = Eigen::Matrix<double, 8, 1>;

/// One Gauss-Newton step over the matches whose residual is at most `limit`. Lengths are divided by
/// `reach_mm`, so that all parameters are of one size. Returns the rms residual before the step.
double step(const std::vector<Match>& matches, bool with_perspective, double reach_mm, double limit,
            PlaneFit& fit) {
    Eigen::Matrix<double, 8, 8> normal = Eigen::Matrix<double, 8, 8>::Zero();
    Parameters right = Parameters::Zero();
    double squares = 0;
    double count = 0;
    for (const Match& match : matches) {
        const Vector2d d = match.nominal_mm - fit.centre_mm;
        const double divisor = 1 + fit.perspective_per_mm.dot(d);
        const Vector2d projected = fit.linear * d / divisor;
        const Vector2d residual = match.seen - fit.offset - projected;
        if (residual.norm() > limit) continue;
        squares += residual.squaredNorm();
        count += 2;
        const Vector2d lever = d / (divisor * reach_mm);
        for (int axis = 0; axis < 2; ++axis) {
            Parameters slope = Parameters::Zero();
            slope[axis] = 1;
            slope.segment<2>(2 + 2 * axis) = lever;
            if (with_perspective) slope.segment<2>(6) = -projected[axis] / reach_mm * lever;
            normal += slope * slope.transpose();
            right += slope * residual[axis];
        }
    }
    if (!with_perspective) normal.diagonal().tail<2>().setOnes();
    const Parameters change = normal.ldlt().solve(right);
    fit.offset += change.head<2>();
    fit.linear.row(0) += change.segment<2>(2).transpose() / reach_mm;
    fit.linear.row(1) += change.segment<2>(4).transpose() / reach_mm;
    fit.perspective_per_mm += change.tail<2>() / (reach_mm * reach_mm);
    return count > 0 ? std::sqrt(squares / count) : 0;
}

}  // namespace

Vector2d PlaneFit::seen(const Vector2d& nominal_mm) const {
    const Vector2d d = nominal_mm - centre_mm;
    return offset + linear * d / (1 + perspective_per_mm.dot(d));
}

PlaneFit fit_plane(const std::vector<Match>& matches, bool with_perspective) {
    PlaneFit fit;
    const auto count = static_cast<double>(matches.size());
    for (const Match& match : matches) {
        fit.centre_mm += match.nominal_mm / count;
        fit.offset += match.seen / count;
    }
    double reach_mm = 0;
    for (const Match& match : matches)
        reach_mm += (match.nominal_mm - fit.centre_mm).norm() / count;
    double limit = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kRounds; ++round) {
        // The first steps go without perspective, which needs a start that is nearly right.
        for (int i = 0; i < kSteps; ++i)
            fit.residual =
                step(matches, with_perspective && (round > 0 || i > 0), reach_mm, limit, fit);
        limit = kOutlier_sigmas * std::sqrt(2.0) * fit.residual;
    }
    return fit;
}

}  // namespace dotpose::calibrate
