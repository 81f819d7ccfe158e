#include "calibrate/print_fit.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace dotpose::calibrate {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr int kRounds = 2;
constexpr int kSteps = 6;
constexpr double kOutlier_sigmas = 4;
using Parameters = Eigen::Matrix<double, 9, 1>;
constexpr int kPerspective = 6;
constexpr int kLens = 8;

/// Lengths by which parameters are scaled to similar size.
struct Reach {
    double paper_mm = 0;
    double seen = 0;
};

/// Which parameters are fitted.
struct Free {
    bool perspective = false;
    bool lens = false;
};

/// Returns the derivative of the lens's displacement at the place `q`, counted from the lens
/// centre.
Matrix2d lens_slope(const PlaneFit& fit, const Vector2d& q) {
    return (1 + fit.lens * q.squaredNorm()) * Matrix2d::Identity() +
           2 * fit.lens * q * q.transpose();
}

/// Makes one Gauss-Newton step over the matches whose residual is at most `limit`. Returns the rms
/// residual before the step.
double step(const std::vector<Match>& matches, Free free, const Reach& reach, double limit,
            PlaneFit& fit) {
    Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
    Parameters right = Parameters::Zero();
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
            Parameters slope = Parameters::Zero();
            slope.head<2>() = by_q.row(axis);
            slope.segment<2>(2) = by_q(axis, 0) * lever;
            slope.segment<2>(4) = by_q(axis, 1) * lever;
            if (free.perspective) {
                const double along = by_q.row(axis).dot(projected) / reach.paper_mm;
                slope.segment<2>(kPerspective) = -along * lever;
            }
            if (free.lens) slope[kLens] = by_lens[axis];
            normal += slope * slope.transpose();
            right += slope * residual[axis];
        }
    }
    if (!free.perspective) normal.diagonal().segment<2>(kPerspective).setOnes();
    if (!free.lens) normal(kLens, kLens) = 1;
    const Parameters change = normal.ldlt().solve(right);
    fit.offset += change.head<2>();
    fit.linear.row(0) += change.segment<2>(2).transpose() / reach.paper_mm;
    fit.linear.row(1) += change.segment<2>(4).transpose() / reach.paper_mm;
    fit.perspective_per_mm += change.segment<2>(kPerspective) / (reach.paper_mm * reach.paper_mm);
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
    for (int round = 0; round < kRounds; ++round) {
        // The first steps fix perspective and lens, which need a start that is nearly right.
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
