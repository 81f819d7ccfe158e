#include "calibrate/space_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "calibrate/least_squares.hpp"
#include "calibrate/median.hpp"
#include "calibrate/plane_start.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Number of parameters: position (3), rotation vector in the camera frame (3), displacement of the
/// dots (1).
constexpr int kParameters = 7;
using Parameters = Eigen::Matrix<double, kParameters, 1>;
using Information = Eigen::Matrix<double, kParameters, kParameters>;
using Derivative = Eigen::Matrix<double, 2, kParameters>;

/// A dot that the fit uses. `whitening` transforms the residual so that the errors of its two
/// components are independent and have the same variance.
struct WeightedDot {
    SpaceDot dot;
    Matrix2d whitening = Matrix2d::Identity();
};

/// Residual of a dot in the image (measured minus predicted), and the derivatives of the
/// prediction.
struct PredictedDot {
    Vector2d residual_px;
    Derivative by_parameters;
    Matrix2d px_per_mm;  ///< derivative with respect to the position of the dot on the paper
    bool is_in_front = false;
};

PredictedDot predict(const SpaceState& state, const SpaceDot& dot, const Vector2d& focal_px) {
    const Vector2d place = dot.intersection_mm + state.displacement * dot.direction_mm;
    const Vector3d from_camera = Vector3d(place.x(), place.y(), 0) - state.position_mm;
    const Vector3d seen = state.rotation.transpose() * from_camera;
    PredictedDot result;
    result.is_in_front = seen.z() > 0;
    const double depth = seen.z();
    result.residual_px =
        dot.pixel - Vector2d(focal_px.x() * seen.x() / depth, focal_px.y() * seen.y() / depth);
    Eigen::Matrix<double, 2, 3> by_seen;
    by_seen << focal_px.x() / depth, 0, -focal_px.x() * seen.x() / (depth * depth),  //
        0, focal_px.y() / depth, -focal_px.y() * seen.y() / (depth * depth);
    const Eigen::Matrix<double, 2, 3> by_place = by_seen * state.rotation.transpose();
    result.px_per_mm = by_place.leftCols<2>();
    // A rotation of the camera by a small vector r adds `seen` x r to the position in the camera
    // frame.
    for (int i = 0; i < 3; ++i)
        result.by_parameters.col(3 + i) = by_seen * seen.cross(Vector3d::Unit(i));
    result.by_parameters.leftCols<3>() = -by_place;
    result.by_parameters.col(6) = result.px_per_mm * dot.direction_mm;
    return result;
}

SpaceState moved(const SpaceState& state, const Parameters& step) {
    const Vector3d turn = step.segment<3>(3);
    const double angle = turn.norm();
    SpaceState result = state;
    result.position_mm += step.head<3>();
    if (angle > 0) {
        // Normalises the quaternion, so that rounding errors do not accumulate.
        const Eigen::Quaterniond rotation(state.rotation * Eigen::AngleAxisd(angle, turn / angle));
        result.rotation = rotation.normalized().toRotationMatrix();
    }
    result.displacement += step[6];
    return result;
}

/// Normal equations of one linearisation, and the sum of the squared residuals.
struct Sums {
    Information information = Information::Zero();
    Parameters gradient = Parameters::Zero();
    double squares = 0;
};

/// Returns the normal equations linearised at `state`. `squares` is infinite if a dot is not in
/// front of the camera.
Sums sums_at(const SpaceState& state, const std::vector<WeightedDot>& dots,
             const Vector2d& focal_px) {
    Sums sums;
    for (const auto& [dot, whitening] : dots) {
        const PredictedDot predicted = predict(state, dot, focal_px);
        if (!predicted.is_in_front) {
            sums.squares = std::numeric_limits<double>::infinity();
            return sums;
        }
        const Vector2d residual = whitening * predicted.residual_px;
        const Derivative rows = whitening * predicted.by_parameters;
        sums.information.noalias() += rows.transpose() * rows;
        sums.gradient.noalias() += rows.transpose() * residual;
        sums.squares += residual.squaredNorm();
    }
    return sums;
}

struct Minimum {
    SpaceState state;
    Sums sums;
};

/// Finds the local minimum of the sum of squares by the Levenberg-Marquardt method.
Minimum minimum_from(const SpaceState& start, const std::vector<WeightedDot>& dots,
                     const Vector2d& focal_px) {
    constexpr int kMaxSteps = 60;
    constexpr double kMaxDamping = 1e9;
    constexpr double kMinGain = 1e-12;  // relative decrease in the sum of squares
    Minimum now{start, sums_at(start, dots, focal_px)};
    double damping = 1e-4;
    for (int i = 0; i < kMaxSteps && damping < kMaxDamping; ++i) {
        Information damped = now.sums.information;
        damped.diagonal() *= 1 + damping;
        const SpaceState next = moved(now.state, damped.ldlt().solve(now.sums.gradient));
        const Sums sums = sums_at(next, dots, focal_px);
        if (!(sums.squares < now.sums.squares)) {
            damping *= 10;
            continue;
        }
        const bool is_done = now.sums.squares - sums.squares < kMinGain * now.sums.squares;
        now = {next, sums};
        if (is_done) break;
        damping /= 10;
    }
    return now;
}

/// Returns the dots whose whitened residuals are within four standard deviations. The standard
/// deviation is estimated from the median of the squared residuals.
std::vector<WeightedDot> inliers(const SpaceState& state, const std::vector<WeightedDot>& dots,
                                 const Vector2d& focal_px) {
    constexpr double kMaxResidual_sigmas = 4;
    std::vector<double> squares;
    for (const auto& [dot, whitening] : dots)
        squares.push_back((whitening * predict(state, dot, focal_px).residual_px).squaredNorm());
    const double limit =
        kMaxResidual_sigmas * kMaxResidual_sigmas * upper_median(squares) / kMedianOfSquaredLength;
    std::vector<WeightedDot> kept;
    for (std::size_t i = 0; i < dots.size(); ++i) {
        if (squares[i] <= limit) kept.push_back(dots[i]);
    }
    return kept;
}

/// Error model for the dots. The covariance of a dot is the sum of two parts: the print error,
/// which is isotropic on the paper, and the error of the measured centre. The model estimates the
/// fraction of the variance that is due to print errors.
class NoiseModel {
  public:
    NoiseModel(const SpaceState& state, const std::vector<WeightedDot>& dots,
               const Vector2d& focal_px) {
        for (const auto& [dot, whitening] : dots) {
            const PredictedDot predicted = predict(state, dot, focal_px);
            const Matrix2d shape = predicted.px_per_mm * predicted.px_per_mm.transpose();
            print_.push_back(shape);
            centre_.push_back(dot.centre_covariance);
            residuals_.push_back(predicted.residual_px);
        }
        normalize(print_);
        normalize(centre_);
    }

    /// Finds the most likely value of the fraction of the variance that is due to print errors, and
    /// sets the whitening of the dots for this fraction.
    void whiten(std::vector<WeightedDot>& dots) const {
        const double fraction = likeliest_fraction();
        for (std::size_t i = 0; i < dots.size(); ++i) {
            const Eigen::LLT<Matrix2d> root(covariance(i, fraction));
            dots[i].whitening = root.matrixL().solve(Matrix2d::Identity());
        }
    }

  private:
    /// Scales the covariances so that the harmonic mean of their variances (trace / 2) is 1. The
    /// harmonic mean is used because a few large covariances hardly affect it.
    static void normalize(std::vector<Matrix2d>& covariances) {
        double sum = 0;
        for (const Matrix2d& covariance : covariances)
            sum += 2 / covariance.trace();
        for (Matrix2d& covariance : covariances)
            covariance *= sum / static_cast<double>(covariances.size());
    }
    /// Covariance of dot `i`, up to a common factor.
    Matrix2d covariance(std::size_t i, double fraction) const {
        return (1 - fraction) * centre_[i] + fraction * print_[i];
    }
    /// Returns -2 log(likelihood) at the most likely common factor, up to an additive constant.
    double cost(double fraction) const {
        double squares = 0;
        double log_determinants = 0;
        for (std::size_t i = 0; i < residuals_.size(); ++i) {
            const Matrix2d variance = covariance(i, fraction);
            squares += residuals_[i].dot(variance.inverse() * residuals_[i]);
            log_determinants += std::log(variance.determinant());
        }
        return 2 * static_cast<double>(residuals_.size()) * std::log(squares) + log_determinants;
    }
    double likeliest_fraction() const {
        // Golden-section search. The fraction 1 is excluded, because the image covariances of print
        // errors are singular if the camera sees the plane edge-on.
        constexpr double kMaxFraction = 0.999;
        constexpr double kTolerance = 0.02;
        double low = 0;
        double high = kMaxFraction;
        const double part = 1 / std::numbers::phi;
        double left = high - part * (high - low);
        double right = low + part * (high - low);
        double left_cost = cost(left);
        double right_cost = cost(right);
        while (high - low > kTolerance) {
            if (left_cost < right_cost) {
                high = right;
                right = left;
                right_cost = left_cost;
                left_cost = cost(left = high - part * (high - low));
            } else {
                low = left;
                left = right;
                left_cost = right_cost;
                right_cost = cost(right = low + part * (high - low));
            }
        }
        return (low + high) / 2;
    }

    std::vector<Matrix2d> print_;   ///< image covariances due to print errors
    std::vector<Matrix2d> centre_;  ///< image covariances due to measurement errors
    std::vector<Vector2d> residuals_;
};

/// The one or two local minima of the pose fit. Both solutions use the same dots and weights, which
/// are determined from the first solution.
struct Solutions {
    std::vector<WeightedDot> dots;
    Minimum first;
    std::optional<Minimum> second;

    /// Exchanges the solutions if the second solution has smaller residuals. Returns true if the
    /// solutions were exchanged.
    bool put_better_first() {
        if (!second || !(second->sums.squares < first.sums.squares)) return false;
        std::swap(first, *second);
        return true;
    }
};

/// Returns true if two minima found from different starts are the same. Compares only the
/// rotations.
bool is_same(const SpaceState& a, const SpaceState& b) {
    constexpr double kSame_rad = 1e-4;
    return Eigen::Quaterniond(a.rotation).angularDistance(Eigen::Quaterniond(b.rotation)) <
           kSame_rad;
}

/// Returns rough solutions, fitted to at most 300 of the dots to save time.
Solutions rough_solutions(const std::array<SpaceState, 2>& starts,
                          const std::vector<WeightedDot>& all, const Vector2d& focal_px) {
    constexpr std::size_t kDots = 300;
    Solutions result;
    for (std::size_t i = 0; i < all.size(); i += 1 + all.size() / kDots)
        result.dots.push_back(all[i]);
    result.first = minimum_from(starts[0], result.dots, focal_px);
    const Minimum second = minimum_from(starts[1], result.dots, focal_px);
    if (!is_same(result.first.state, second.state)) result.second = second;
    result.put_better_first();
    return result;
}

/// Refines both solutions. Uses the first solution to reject outliers and to estimate the weights.
/// Then refits the second solution with the same dots and weights.
void refine(const std::vector<WeightedDot>& all, const Vector2d& focal_px, Solutions& solutions) {
    constexpr int kRounds = 2;
    solutions.first = minimum_from(solutions.first.state, all, focal_px);
    for (int round = 0; round < kRounds; ++round) {
        solutions.dots = inliers(solutions.first.state, all, focal_px);
        NoiseModel(solutions.first.state, solutions.dots, focal_px).whiten(solutions.dots);
        solutions.first = minimum_from(solutions.first.state, solutions.dots, focal_px);
    }
    if (!solutions.second) return;
    solutions.second = minimum_from(solutions.second->state, solutions.dots, focal_px);
    if (is_same(solutions.first.state, solutions.second->state)) solutions.second.reset();
}

double residual_px(const Solutions& solutions, const Vector2d& focal_px) {
    double squares = 0;
    for (const auto& [dot, whitening] : solutions.dots)
        squares += predict(solutions.first.state, dot, focal_px).residual_px.squaredNorm();
    return std::sqrt(squares / (2 * static_cast<double>(solutions.dots.size())));
}

}  // namespace

std::optional<SpaceFit> fit_space(const std::vector<SpaceDot>& dots, const Vector2d& focal_px) {
    const auto starts = plane_starts(dots, focal_px);
    if (!starts) return std::nullopt;
    std::vector<WeightedDot> all;
    for (const SpaceDot& dot : dots)
        all.push_back({dot});
    Solutions solutions = rough_solutions(*starts, all, focal_px);
    refine(all, focal_px, solutions);
    if (solutions.put_better_first()) refine(all, focal_px, solutions);

    const Minimum& first = solutions.first;
    const auto count = static_cast<double>(2 * solutions.dots.size());
    if (!(count > kParameters) || !std::isfinite(first.sums.squares)) return std::nullopt;
    SpaceFit fit;
    fit.state = first.state;
    fit.residual_px = residual_px(solutions, focal_px);
    const Information inverse = inverse_of(first.sums.information);
    for (const auto& [dot, whitening] : solutions.dots) {
        const PredictedDot predicted = predict(first.state, dot, focal_px);
        const Parameters gradient =
            (whitening * predicted.by_parameters).transpose() * whitening * predicted.residual_px;
        fit.used.push_back(dot);
        fit.influences.push_back((inverse * gradient).head<6>());
    }
    fit.covariance = first.sums.squares / (count - kParameters) * inverse.topLeftCorner<6, 6>();
    if (solutions.second && std::isfinite(solutions.second->sums.squares)) {
        fit.second = solutions.second->state;
        // If the errors are Gaussian with an unknown variance, the likelihood of a solution is
        // proportional to squares^(-count / 2).
        const double ratio = solutions.second->sums.squares / first.sums.squares;
        fit.second_odds_log2 = std::min(-count / 2 * std::log2(ratio), 0.0);
    }
    return fit;
}

}  // namespace dotpose::calibrate
