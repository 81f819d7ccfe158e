// Mapped fix: fits the pose of a frame to the dots at their mapped places.
#include <algorithm>
#include <cmath>
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
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// A measured dot. Places are in spacings from `Decoding::place`.
struct MapDot {
    Vector2d pixel;  ///< relative to the centre of the plane
    Vector2d step;
    Vector2d direction;
    Vector2d offset;
};

/// Terms of the correction: place (2), scale, rotation, displacement, shear (2), perspective (2).
constexpr int kSimilarityTerms = 5;
constexpr int kTerms = 9;
constexpr double kReach_px = 100;  ///< unit of pixels in the terms

/// Derivatives of a place on the paper with respect to the terms.
Eigen::Matrix<double, 2, kTerms> derivatives_at(const FixPlane& plane, const MapDot& dot) {
    const Vector2d p = plane.place(dot.pixel) - plane.at;
    const Vector2d q = dot.pixel / kReach_px;
    Eigen::Matrix<double, 2, kTerms> rows;
    rows << 1, 0, p.x(), -p.y(), -dot.direction.x(), p.x(), p.y(), p.x() * q.x(), p.x() * q.y(),  //
        0, 1, p.y(), p.x(), -dot.direction.y(), -p.y(), p.x(), p.y() * q.x(), p.y() * q.y();
    return rows;
}

/// Correction of a plane, by least squares.
struct Correction {
    VectorXd terms = VectorXd::Zero(kTerms);
    MatrixXd covariance = MatrixXd::Zero(kTerms, kTerms);
    double variance = 0;  ///< variance of the residuals, per axis
    int dots = 0;
};

/// Solves the normal equations of the dots whose squared residuals in the previous fit are at most
/// `limit`.
Correction correct(const FixPlane& plane, const std::vector<MapDot>& dots, double map_weight,
                   const VectorXd& last, double limit, const std::vector<int>& used) {
    const auto count = static_cast<Eigen::Index>(used.size());
    MatrixXd normal = MatrixXd::Zero(count, count);
    VectorXd right = VectorXd::Zero(count);
    double squares = 0;
    Correction result;
    for (const MapDot& dot : dots) {
        const auto all = derivatives_at(plane, dot);
        const Vector2d wanted = dot.step + map_weight * dot.offset - plane.place(dot.pixel);
        if ((wanted - all * last).squaredNorm() > limit) continue;
        MatrixXd rows(2, count);
        for (Eigen::Index k = 0; k < count; ++k)
            rows.col(k) = all.col(used[static_cast<std::size_t>(k)]);
        normal += rows.transpose() * rows;
        right += rows.transpose() * wanted;
        squares += wanted.squaredNorm();
        ++result.dots;
    }
    const MatrixXd inverse = normal.ldlt().solve(MatrixXd::Identity(count, count));
    const VectorXd solution = inverse * right;
    const double left = std::max(squares - solution.dot(right), 0.0);
    result.variance = left / std::max<double>(2.0 * result.dots - static_cast<double>(count), 1);
    for (Eigen::Index i = 0; i < count; ++i) {
        const int to = used[static_cast<std::size_t>(i)];
        result.terms[to] = solution[i];
        for (Eigen::Index j = 0; j < count; ++j)
            result.covariance(to, used[static_cast<std::size_t>(j)]) =
                result.variance * inverse(i, j);
    }
    return result;
}

/// Fits the terms in `used`. Repeats the fit without outliers.
Correction fit_terms(const FixPlane& plane, const std::vector<MapDot>& dots, double map_weight,
                     const std::vector<int>& used) {
    VectorXd last = VectorXd::Zero(kTerms);
    last[4] = 1.0 / 6;
    Correction result;
    double limit = 0.04;  // initial limit of the squared residual, in spacings^2
    constexpr int kRounds = 4;
    for (int round = 0; round < kRounds; ++round) {
        result = correct(plane, dots, map_weight, last, limit, used);
        last = result.terms;
        std::vector<double> squares;
        for (const MapDot& dot : dots) {
            const Vector2d wanted = dot.step + map_weight * dot.offset - plane.place(dot.pixel);
            squares.push_back((wanted - derivatives_at(plane, dot) * last).squaredNorm());
        }
        limit = kMaxSquaredLength * upper_median(std::move(squares)) / kMedianOfSquaredLength;
    }
    return result;
}

/// Returns true if the two terms from index `first` differ significantly from 0. The limit is high,
/// because the plane of the fix is already a good estimate, and because each additional term makes
/// the place less accurate.
bool are_significant(const Correction& fit, int first) {
    constexpr double kSignificant = 20;
    const Vector2d terms = fit.terms.segment<2>(first);
    const Matrix2d covariance = fit.covariance.block<2, 2>(first, first);
    return terms.dot(covariance.inverse() * terms) > kSignificant;
}

/// Fits place, scale, rotation and displacement. Also fits shear and perspective if they are
/// significant.
Correction fit_correction(const FixPlane& plane, const std::vector<MapDot>& dots,
                          double map_weight) {
    const Correction full = fit_terms(plane, dots, map_weight, {0, 1, 2, 3, 4, 5, 6, 7, 8});
    std::vector<int> used = {0, 1, 2, 3, 4};
    for (const int first : {kSimilarityTerms, kSimilarityTerms + 2}) {
        if (are_significant(full, first)) used.insert(used.end(), {first, first + 1});
    }
    return used.size() == kTerms ? full : fit_terms(plane, dots, map_weight, used);
}

/// Returns the image point, relative to the centre of the plane, that the plane maps to the place
/// of the fix.
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
    // Approximates the derivative of the place along the image x axis by the difference between
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
    const Correction with_map = fit_correction(plane, dots, 1);
    const Correction without = fit_correction(plane, dots, 0);
    if (!is_same_print(with_map.variance, without.variance, mapped.noise))
        return {fix, MapUse::contradicted};
    MappedFix result{fix, MapUse::used};
    write_fix(plane, with_map, trace, result.fix);
    return result;
}

}  // namespace dotpose
