#include "calibrate/print_fit.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "calibrate/least_squares.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr int kPrintRounds = 2;
constexpr int kSteps = 6;
constexpr double kOutlier_sigmas = 4;
/// Indices of the parameters. The order is offset, rows of `linear`, perspective, lens.
constexpr int kLinear = 2;
constexpr int kPerspective = 6;
constexpr int kLens = 8;

/// Lengths that scale the parameters to similar magnitudes.
struct Reach {
    double paper_mm = 0;
    double seen = 0;
};

/// Selects which optional parameters are fitted.
struct Free {
    bool perspective = false;
    bool lens = false;
};

/// Returns the derivative of the distorted position with respect to the undistorted position `q`.
/// Both positions are relative to the lens centre.
Matrix2d lens_slope(const PlaneFit& fit, const Vector2d& q) {
    return (1 + fit.lens * q.squaredNorm()) * Matrix2d::Identity() +
           2 * fit.lens * q * q.transpose();
}

/// Performs one Gauss-Newton step with the matches whose residuals are at most `limit`. Returns the
/// rms residual before the step.
double step(const std::vector<Match>& matches, Free free, const Reach& reach, double limit,
            PlaneFit& fit) {
    NormalEquations equations(9);
    double squares = 0;
    double count = 0;
    for (const Match& match : matches) {
        const Vector2d d = match.nominal_mm - fit.centre_mm;
        const double divisor = 1 + fit.perspective_per_mm.dot(d);
        const Vector2d projected = fit.linear * d / divisor;
        const Vector2d q = fit.offset + projected;
        const Vector2d residual =
            match.seen - fit.lens_centre - q * (1 + fit.lens * q.squaredNorm());
        if (residual.norm() > limit) continue;
        squares += residual.squaredNorm();
        count += 2;
        const Matrix2d by_q = lens_slope(fit, q);
        const Vector2d lever = d / (divisor * reach.paper_mm);
        const Vector2d by_lens = q * (q.squaredNorm() / (reach.seen * reach.seen));
        for (int axis = 0; axis < 2; ++axis) {
            const double a = by_q(axis, 0);
            const double b = by_q(axis, 1);
            const double along = (a * projected.x() + b * projected.y()) / reach.paper_mm;
            const double perspective = free.perspective ? -along : 0;
            equations.add(std::array{a, b, a * lever.x(), a * lever.y(), b * lever.x(),
                                     b * lever.y(), perspective * lever.x(),
                                     perspective * lever.y(), free.lens ? by_lens[axis] : 0},
                          residual[axis]);
        }
    }
    if (!free.perspective) {
        equations.pull_to_zero(kPerspective, 1);
        equations.pull_to_zero(kPerspective + 1, 1);
    }
    if (!free.lens) equations.pull_to_zero(kLens, 1);
    const std::vector<double> change = equations.solution();
    const auto pair = [&](std::size_t first) { return Vector2d(change[first], change[first + 1]); };
    fit.offset += pair(0);
    fit.linear.row(0) += pair(kLinear) / reach.paper_mm;
    fit.linear.row(1) += pair(kLinear + 2) / reach.paper_mm;
    fit.perspective_per_mm += pair(kPerspective) / (reach.paper_mm * reach.paper_mm);
    fit.lens += change[kLens] / (reach.seen * reach.seen);
    return count > 0 ? std::sqrt(squares / count) : 0;
}

}  // namespace

Vector2d PlaneFit::seen(const Vector2d& nominal_mm) const {
    const Vector2d d = nominal_mm - centre_mm;
    const Vector2d q = offset + linear * d / (1 + perspective_per_mm.dot(d));
    return lens_centre + q * (1 + lens * q.squaredNorm());
}

double PlaneFit::units_per_mm(const Vector2d& nominal_mm) const {
    const Vector2d d = nominal_mm - centre_mm;
    const double divisor = 1 + perspective_per_mm.dot(d);
    const Vector2d projected = linear * d / divisor;
    const Matrix2d slope = (linear - projected * perspective_per_mm.transpose()) / divisor;
    return std::sqrt(std::abs((lens_slope(*this, offset + projected) * slope).determinant()));
}

PlaneFit fit_plane(const std::vector<Match>& matches, ViewModel model,
                   const Vector2d& lens_centre) {
    PlaneFit fit;
    fit.lens_centre = lens_centre;
    const auto count = static_cast<double>(matches.size());
    for (const Match& match : matches) {
        fit.centre_mm += match.nominal_mm / count;
        fit.offset += (match.seen - lens_centre) / count;
    }
    Reach reach;
    for (const Match& match : matches) {
        reach.paper_mm += (match.nominal_mm - fit.centre_mm).norm() / count;
        reach.seen += (match.seen - lens_centre).norm() / count;
    }
    double limit = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kPrintRounds; ++round) {
        // Perspective and lens are not fitted in the first steps, because their fit requires
        // approximate values of the other parameters.
        for (int i = 0; i < kSteps; ++i) {
            const bool has_start = round > 0 || i > 0;
            const Free free{has_start && model != ViewModel::flat,
                            has_start && model == ViewModel::camera && (round > 0 || i > 2)};
            fit.residual = step(matches, free, reach, limit, fit);
        }
        limit = kOutlier_sigmas * std::sqrt(2.0) * fit.residual;
    }
    return fit;
}

}  // namespace dotpose::calibrate
