// Fits the pose of a frame to the dot positions in a print map.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>

#include "calibrate/fix_plane.hpp"
#include "calibrate/mapped_dots.hpp"
#include "calibrate/median.hpp"
#include "dotpose/tools/print_mapping.hpp"

namespace dotpose {
namespace {

using namespace dotpose::calibrate;
using Eigen::Matrix2d;
using Eigen::Vector2d;

/// A measured dot. Positions on the paper are in spacings from `Decoding::place`.
struct MapDot {
    Vector2d pixel;  ///< relative to the centre of the plane
    Vector2d step;
    Vector2d direction;
    Vector2d offset;
};

/// Number of terms of the correction: position (2), scale, rotation, displacement, shear (2),
/// perspective (2).
constexpr int kTerms = 9;
constexpr int kDisplacement = 4;
constexpr int kShear = 5;
constexpr int kPerspective = 7;
constexpr double kReach_px = 100;  ///< unit of image coordinates in the terms
using Terms = Eigen::Matrix<double, kTerms, 1>;
using TermBlock = Eigen::Matrix<double, kTerms, kTerms>;

/// Returns the derivatives of the position of a dot on the paper with respect to the terms.
Eigen::Matrix<double, 2, kTerms> derivatives_at(const FixPlane& plane, const MapDot& dot) {
    const Vector2d p = plane.place(dot.pixel) - plane.at;
    const Vector2d q = dot.pixel / kReach_px;
    Eigen::Matrix<double, 2, kTerms> rows;
    rows << 1, 0, p.x(), -p.y(), -dot.direction.x(), p.x(), p.y(), p.x() * q.x(), p.x() * q.y(),  //
        0, 1, p.y(), p.x(), -dot.direction.y(), -p.y(), p.x(), p.y() * q.x(), p.y() * q.y();
    return rows;
}

/// Correction of a plane, fitted to dots.
struct Correction {
    Terms terms = Terms::Zero();
    TermBlock covariance = TermBlock::Zero();
    double variance = 0;  ///< variance of the residuals, per axis
    int dots = 0;
};

/// Returns the position of a dot according to the map, minus its position according to the plane.
Vector2d residual_of(const FixPlane& plane, const MapDot& dot, double map_weight) {
    return dot.step + map_weight * dot.offset - plane.place(dot.pixel);
}

/// Solves the normal equations of the dots whose squared residuals in the previous fit are at most
/// `limit`.
Correction correct(const FixPlane& plane, const std::vector<MapDot>& dots, double map_weight,
                   const Terms& last, double limit) {
    TermBlock normal = TermBlock::Zero();
    Terms right = Terms::Zero();
    double squares = 0;
    Correction result;
    for (const MapDot& dot : dots) {
        const auto rows = derivatives_at(plane, dot);
        const Vector2d residual = residual_of(plane, dot, map_weight);
        if ((residual - rows * last).squaredNorm() > limit) continue;
        normal += rows.transpose() * rows;
        right += rows.transpose() * residual;
        squares += residual.squaredNorm();
        ++result.dots;
    }
    const TermBlock inverse = normal.ldlt().solve(TermBlock::Identity());
    result.terms = inverse * right;
    // Lower limit of the variance. It keeps the covariance invertible. With any real camera, the
    // variance is much larger.
    constexpr double kExact = 1e-12;
    const double left = squares - result.terms.dot(right);
    result.variance = std::max(left / std::max<double>(2.0 * result.dots - kTerms, 1), kExact);
    result.covariance = result.variance * inverse;
    return result;
}

/// Fits all terms by least squares, and repeats the fit without outliers.
Correction fit_terms(const FixPlane& plane, const std::vector<MapDot>& dots, double map_weight) {
    Terms last = Terms::Zero();
    last[kDisplacement] = 1.0 / 6;
    Correction result;
    double limit = 0.04;  // initial limit of the squared residual, in spacings^2
    constexpr int kRounds = 4;
    for (int round = 0; round < kRounds; ++round) {
        result = correct(plane, dots, map_weight, last, limit);
        last = result.terms;
        std::vector<double> squares;
        for (const MapDot& dot : dots) {
            squares.push_back(
                (residual_of(plane, dot, map_weight) - derivatives_at(plane, dot) * last)
                    .squaredNorm());
        }
        limit = kMaxSquaredLength * upper_median(std::move(squares)) / kMedianOfSquaredLength;
    }
    return result;
}

/// Prior on the two shear terms or the two perspective terms: a mixture of Gaussians with mean 0.
/// The terms are 0 if the optical axis is perpendicular to the paper.
struct ViewPrior {
    struct Kind {
        double probability;
        double deviation;  ///< standard deviation of each term
    };
    int first;  ///< index of the first term
    std::array<Kind, 3> kinds;
};
/// The priors are the same as in `locate` (core/fit/solve_plane.cpp). The unit of the perspective
/// is the relative change in scale from the centre to the outermost dot.
constexpr ViewPrior kPerspectivePrior{kPerspective, {{{0.1, 0}, {0.8, 0.01}, {0.1, 0.1}}}};
constexpr ViewPrior kShearPrior{kShear, {{{0.5, 0}, {0.4, 0.002}, {0.1, 0.03}}}};

/// Applies a prior to two terms of `fit`. `present` contains the values of these terms in the plane
/// of the fix, before the correction. The prior applies to the corrected values, which are the sums
/// of `present` and the terms of `fit`, and its standard deviations are multiplied by `unit`.
/// Changes the two corrected values to their posterior means, and the other terms accordingly.
void shrink(const ViewPrior& prior, const Vector2d& present, double unit, Correction& fit) {
    struct Posterior {
        double distance;  ///< squared Mahalanobis distance of the fitted terms from 0
        double weight;
        Vector2d mean;
        Matrix2d covariance;
    };
    const Vector2d fitted = fit.terms.segment<2>(prior.first) + present;
    const Matrix2d covariance = fit.covariance.block<2, 2>(prior.first, prior.first);
    std::array<Posterior, 3> kinds;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        const double deviation = prior.kinds[k].deviation * unit;
        const Matrix2d all = covariance + deviation * deviation * Matrix2d::Identity();
        const Matrix2d kept = Matrix2d::Identity() - covariance * all.inverse();
        kinds[k] = {fitted.dot(all.inverse() * fitted),
                    prior.kinds[k].probability / std::sqrt(all.determinant()), kept * fitted,
                    kept * covariance};
        nearest = std::min(nearest, kinds[k].distance);
    }
    double sum = 0;
    Vector2d mean = Vector2d::Zero();
    for (Posterior& kind : kinds) {
        kind.weight *= std::exp((nearest - kind.distance) / 2);
        sum += kind.weight;
        mean += kind.weight * kind.mean;
    }
    mean /= sum;
    Matrix2d change = -covariance;
    for (const Posterior& kind : kinds) {
        const Vector2d off = kind.mean - mean;
        change += kind.weight / sum * (kind.covariance + off * off.transpose());
    }
    const Eigen::Matrix<double, kTerms, 2> gain =
        fit.covariance.middleCols<2>(prior.first) * covariance.inverse();
    fit.terms += gain * (mean - fitted);
    fit.covariance += gain * change * gain.transpose();
}

/// Shrinks perspective and shear to their posterior means. Without the shrinkage, the noise of
/// these terms would make the position less accurate. The perspective and shear in the plane of the
/// fix cannot be used instead, because they were fitted without the map and have larger errors.
void shrink_view(const FixPlane& plane, const std::vector<MapDot>& dots, Correction& fit) {
    double reach_px = 1;
    for (const MapDot& dot : dots)
        reach_px = std::max(reach_px, dot.pixel.norm());
    shrink(kPerspectivePrior, -plane.perspective * kReach_px, kReach_px / reach_px, fit);
    // The shear of the plane is the traceless part of the symmetric factor in its polar
    // decomposition.
    const Matrix2d square = plane.linear * plane.linear.transpose();
    const double root = std::sqrt(square.determinant());
    const Matrix2d stretch = square + root * Matrix2d::Identity();
    shrink(kShearPrior,
           Vector2d(stretch(0, 0) - stretch(1, 1), 2 * stretch(0, 1)) / stretch.trace(), 1, fit);
}

/// Returns the image point, relative to the centre of the plane, that the plane maps to the
/// position of the fix.
Vector2d reference_of(const FixPlane& plane, const Trace& trace, const Fix& fix) {
    const Cell start = trace.decoding.place.cell;
    const Vector2d place(steps(start.x, fix.cell.x) + fix.fraction_x_q16 / 65536.0,
                         steps(start.y, fix.cell.y) + fix.fraction_y_q16 / 65536.0);
    Vector2d q = Vector2d::Zero();
    constexpr int kIterations = 8;
    for (int i = 0; i < kIterations; ++i) {
        const double divisor = 1 + plane.perspective.dot(q) + plane.lens * q.squaredNorm();
        q += plane.linear.inverse() * (place - plane.place(q)) * divisor;
    }
    return q;
}

void write_fix(const FixPlane& plane, const Correction& correction, const Trace& trace, Fix& fix) {
    const Vector2d reference = reference_of(plane, trace, fix);
    const MapDot here{reference, Vector2d::Zero(), Vector2d::Zero(), Vector2d::Zero()};
    const auto at = derivatives_at(plane, here);
    const Vector2d place = plane.place(reference) + at * correction.terms;
    const auto x_q16 = std::llround(place.x() * 65536);
    const auto y_q16 = std::llround(place.y() * 65536);
    const Place cell =
        moved(trace.options.code, trace.decoding.place, static_cast<std::int32_t>(x_q16 >> 16),
              static_cast<std::int32_t>(y_q16 >> 16));
    fix.cell = cell.cell;
    fix.section = cell.section;
    fix.fraction_x_q16 = static_cast<std::uint16_t>(x_q16 & 65535);
    fix.fraction_y_q16 = static_cast<std::uint16_t>(y_q16 & 65535);
    // Approximates the derivative of the position along the image x axis by the difference between
    // two points.
    const double step = 8;
    const MapDot left{reference - Vector2d(step, 0), Vector2d::Zero(), Vector2d::Zero(),
                      Vector2d::Zero()};
    const MapDot right{reference + Vector2d(step, 0), Vector2d::Zero(), Vector2d::Zero(),
                       Vector2d::Zero()};
    const Eigen::Matrix<double, 2, kTerms> slope =
        derivatives_at(plane, right) - derivatives_at(plane, left);
    const Vector2d before = plane.place(right.pixel) - plane.place(left.pixel);
    const Vector2d along = before + slope * correction.terms;
    const double turn =
        std::atan2(before.x() * along.y() - before.y() * along.x(), before.dot(along));
    constexpr double kBam_per_rad = 2147483648.0 / std::numbers::pi;
    fix.theta_bam = static_cast<std::int32_t>(
        static_cast<std::uint32_t>(fix.theta_bam) +
        static_cast<std::uint32_t>(static_cast<std::int64_t>(std::llround(turn * kBam_per_rad))));
    Eigen::Matrix<double, 3, kTerms> gradients;
    gradients.topRows<2>() = at;
    gradients.row(2) = (along.x() * slope.row(1) - along.y() * slope.row(0)) / along.squaredNorm();
    const Eigen::Matrix3d covariance = gradients * correction.covariance * gradients.transpose();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            fix.covariance[i][j] = static_cast<float>(covariance(i, j));
    }
    fix.residual_px = static_cast<float>(std::sqrt(correction.variance) * fix.spacing_px());
    fix.dots_used = correction.dots;
    fix.dots_seen = std::max(fix.dots_seen, fix.dots_used);
}

}  // namespace

MappedFix with_print_map(const Fix& fix, const PrintMap& map, const Trace& trace) {
    const MappedDots mapped = mapped_dots(fix, map, trace);
    if (mapped.use != MapUse::used) return {fix, mapped.use};
    const FixPlane plane(trace.pattern_from_image);
    std::vector<MapDot> dots;
    for (const auto& [dot, offset] : mapped.dots) {
        dots.push_back({Vector2d(dot.pixel.u, dot.pixel.v) - plane.centre_px,
                        Vector2d(dot.step.x, dot.step.y), Vector2d(dx(dot.symbol), dy(dot.symbol)),
                        offset});
    }
    Correction with_map = fit_terms(plane, dots, 1);
    const Correction without = fit_terms(plane, dots, 0);
    if (!is_same_print(with_map.variance, without.variance, mapped.noise))
        return {fix, MapUse::contradicted};
    shrink_view(plane, dots, with_map);
    MappedFix result{fix, MapUse::used};
    write_fix(plane, with_map, trace, result.fix);
    add_map_error(*mapped.page, result.fix);
    return result;
}

}  // namespace dotpose
