#include "calibrate/pivot_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_map>

#include <Eigen/Eigenvalues>

#include "calibrate/least_squares.hpp"
#include "calibrate/median.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix36d = Eigen::Matrix<double, 3, 6>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr int kSubsets = 500;
constexpr std::size_t kSubsetViews = 4;
constexpr int kMaxIterations = 20;
/// Median and 0.9999 quantile of the chi-square distribution with three degrees of freedom.
constexpr double kMedianSquare = 2.366;
constexpr double kMaxSquare = 21.1;

/// Tip in the camera frame and resting point on the paper.
struct Points {
    Vector3d tip_mm = Vector3d::Zero();
    Vector3d rest_mm = Vector3d::Zero();
};

Vector3d residual_mm(const PivotView& view, const Points& points) {
    return view.position_mm + view.rotation * points.tip_mm - points.rest_mm;
}

/// Returns the derivative of the tip position on the paper with respect to the pose.
Matrix36d by_pose(const PivotView& view, const Vector3d& tip_mm) {
    Matrix3d cross;
    cross << 0, -tip_mm.z(), tip_mm.y(), tip_mm.z(), 0, -tip_mm.x(), -tip_mm.y(), tip_mm.x(), 0;
    Matrix36d result;
    result << Matrix3d::Identity(), -view.rotation * cross;
    return result;
}

/// Returns the matrix that transforms residuals into independent residuals of variance 1, assuming
/// that the tip position in the camera frame is exact.
Matrix3d whitening_at(const PivotView& view, const Vector3d& tip_mm) {
    return whitening_of(propagated(by_pose(view, tip_mm), view.covariance));
}

/// Adds the three equations of a view, multiplied by `whitening`.
void add(NormalEquations& equations, const PivotView& view, const Matrix3d& whitening) {
    const Matrix3d by_tip = whitening * view.rotation;
    const Vector3d wanted = -whitening * view.position_mm;
    for (Eigen::Index i = 0; i < 3; ++i) {
        const std::array row{by_tip(i, 0),     by_tip(i, 1),     by_tip(i, 2),
                             -whitening(i, 0), -whitening(i, 1), -whitening(i, 2)};
        equations.add(row, wanted[i]);
    }
}

Points points_of(const NormalEquations& equations) {
    const std::vector<double> solved = equations.solution();
    return {{solved[0], solved[1], solved[2]}, {solved[3], solved[4], solved[5]}};
}

/// Fits many small subsets of the views. Returns the fit with the smallest median residual over all
/// views (Rousseeuw 1984). This method succeeds even if almost half of the views are wrong.
Points robust_start(const std::vector<PivotView>& views) {
    Points best;
    double best_mm = std::numeric_limits<double>::infinity();
    Rng rng(views.size());
    for (int i = 0; i < kSubsets; ++i) {
        std::vector<PivotView> subset;
        for (std::size_t k = 0; k < kSubsetViews; ++k)
            subset.push_back(views[rng.below(static_cast<std::uint32_t>(views.size()))]);
        constexpr double kMinAngle_rad = 0.02;
        if (pivot_angle_rad(subset) < kMinAngle_rad) continue;
        NormalEquations equations(6);
        for (const PivotView& view : subset)
            add(equations, view, Matrix3d::Identity());
        const Points points = points_of(equations);
        std::vector<double> distances_mm;
        for (const PivotView& view : views)
            distances_mm.push_back(residual_mm(view, points).norm());
        const double middle_mm = upper_median(distances_mm);
        if (middle_mm >= best_mm) continue;
        best_mm = middle_mm;
        best = points;
    }
    return best;
}

/// Result of one refinement step: a weighted fit to the views that agree with `start`.
struct Step {
    Points points;
    Matrix6d covariance;  ///< covariance of `points`, assuming independent pose errors
    std::vector<bool> is_used;
    /// Sum of the normalised squared residuals of the used views before the step.
    double squares = 0;
};

Step improved(const std::vector<PivotView>& views, const Points& start) {
    std::vector<Matrix3d> whitenings;
    std::vector<double> squares;
    for (const PivotView& view : views) {
        whitenings.push_back(whitening_at(view, start.tip_mm));
        squares.push_back((whitenings.back() * residual_mm(view, start)).squaredNorm());
    }
    const double scale = std::max(upper_median(squares) / kMedianSquare, 1.0);
    Step step;
    NormalEquations equations(6);
    for (std::size_t i = 0; i < views.size(); ++i) {
        step.is_used.push_back(squares[i] <= kMaxSquare * scale);
        if (!step.is_used.back()) continue;
        add(equations, views[i], whitenings[i]);
        step.squares += squares[i];
    }
    step.points = points_of(equations);
    step.covariance = equations.unit_covariance();
    return step;
}

/// Returns the covariance of the points that results from dot errors. The error of a dot is the
/// same in all frames that show the dot.
Matrix6d covariance_of_dots(const std::vector<PivotView>& views, const Step& step) {
    std::unordered_map<std::uint64_t, Vector6d> shifts;
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (!step.is_used[i]) continue;
        const PivotView& view = views[i];
        const Matrix3d whitening = whitening_at(view, step.points.tip_mm);
        Matrix36d rows;
        rows << whitening * view.rotation, -whitening;
        const Matrix6d gain =
            step.covariance * rows.transpose() * whitening * by_pose(view, step.points.tip_mm);
        for (const DotInfluence& influence : view.influences) {
            const auto [entry, is_new] = shifts.try_emplace(influence.dot, Vector6d::Zero());
            entry->second += gain * influence.shift;
        }
    }
    Matrix6d result = Matrix6d::Zero();
    for (const auto& [dot, shift] : shifts)
        result += shift * shift.transpose();
    return result;
}

}  // namespace

double pivot_angle_rad(const std::vector<PivotView>& views) {
    Matrix3d mean = Matrix3d::Zero();
    for (const PivotView& view : views)
        mean += view.rotation / static_cast<double>(views.size());
    // Mean of (R - mean)' (R - mean) over all rotations R.
    const Matrix3d spread = Matrix3d::Identity() - mean.transpose() * mean;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(spread, Eigen::EigenvaluesOnly);
    return std::sqrt(std::max(solver.eigenvalues()[0], 0.0));
}

PivotFit fit_pivot(const std::vector<PivotView>& given) {
    // Coordinates relative to the first view keep the equations well scaled.
    const Vector3d origin_mm = given.front().position_mm;
    std::vector<PivotView> views = given;
    for (PivotView& view : views)
        view.position_mm -= origin_mm;
    Points points = robust_start(views);
    Step step = improved(views, points);
    for (int i = 0; i < kMaxIterations; ++i) {
        const double moved_mm = (step.points.tip_mm - points.tip_mm).norm();
        points = step.points;
        step = improved(views, points);
        constexpr double kConverged_mm = 1e-7;
        if (moved_mm < kConverged_mm) break;
    }
    PivotFit fit{points.tip_mm, points.rest_mm + origin_mm, covariance_of_dots(views, step),
                 step.is_used};
    const auto used = std::ranges::count(step.is_used, true);
    const auto freedom = static_cast<double>(std::max<std::ptrdiff_t>(3 * used - 6, 1));
    fit.error_ratio = std::sqrt(step.squares / freedom);
    fit.covariance += std::max(fit.error_ratio * fit.error_ratio - 1, 0.0) * step.covariance;
    double squares_mm2 = 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (step.is_used[i]) squares_mm2 += residual_mm(views[i], points).squaredNorm();
    }
    fit.residual_mm = std::sqrt(squares_mm2 / freedom);
    return fit;
}

}  // namespace dotpose::calibrate
