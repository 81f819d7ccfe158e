#include "calibrate/map_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "calibrate/map_errors.hpp"
#include "calibrate/map_geometry.hpp"
#include "calibrate/map_parts.hpp"
#include "calibrate/map_system.hpp"
#include "calibrate/median.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::Vector2d;

/// Number of linearisations. After each linearisation, the variances are estimated and the outliers
/// are marked again.
constexpr int kRounds = 3;
/// Convergence limit of the conjugate gradient method: maximum mean square of the preconditioned
/// residual, relative to the variance of an unknown. A lower limit does not make the map more
/// accurate. All rounds except the last use kFirstConverged, because these rounds only estimate
/// variances and find outliers.
constexpr double kConverged = 1e-6;
constexpr double kFirstConverged = 1e-4;
/// Maximum squared residual of an observation in the first round, in units of the variance per
/// axis. The limit is greater than kMaxSquaredLength, because the offsets of the dots are not known
/// yet.
constexpr double kFirstOutlier = 30;
constexpr double kMinNoise_mm = 1e-4;
constexpr double kMinJitter_mm = 5e-4;
/// Initial values of noise and jitter, in spacings.
constexpr double kFirstNoise = 0.005;
constexpr double kFirstJitter = 0.02;

/// Statistics of the residuals of all frames, given the offsets and views of a solution.
struct Statistics {
    double squares = 0;  ///< sum of the squared residuals without outliers
    std::array<double, kViewTerms> view_sigma{};
};

/// View terms of a frame and their variances, fitted to this frame only. All unknowns that do not
/// belong to the frame are held fixed.
struct FreeView {
    Eigen::Matrix<double, kViewTerms, 1> terms;
    Eigen::Matrix<double, kViewTerms, 1> variance;
};

FreeView free_view(const FrameBlock& block, const FrameVector& right, const MapFrame& frame,
                   double variance) {
    FrameBlock damped = block;
    damped.diagonal().array() += 1e-9 * block.diagonal().maxCoeff();
    const FrameBlock inverse = damped.inverse();
    return {frame.view - (inverse * right).tail<kViewTerms>(),
            variance * inverse.diagonal().tail<kViewTerms>()};
}

/// Returns the frame-to-frame standard deviation of each view term. If a term does not vary by more
/// than its error, the camera is considered rigid in this term and the result is nearly 0.
std::array<double, kViewTerms> view_sigma_of(const std::vector<FreeView>& views) {
    std::array<double, kViewTerms> result{};
    for (int k = 0; k < kViewTerms; ++k) {
        std::vector<double> squares;
        std::vector<double> variances;
        for (const FreeView& view : views) {
            squares.push_back(view.terms[k] * view.terms[k]);
            variances.push_back(view.variance[k]);
        }
        constexpr double kMedianOfSquare = 0.455;  // for a standard normal variable
        constexpr double kRigid = 0.01;
        const double error = upper_median(variances);
        const double variance = upper_median(squares) / kMedianOfSquare - error;
        result[static_cast<std::size_t>(k)] = std::sqrt(std::max(variance, kRigid * error));
    }
    return result;
}

Vector2d residual_of(const MapView& view, const MapView::Terms& terms, const MapSolution& solution,
                     const MapFrame& frame, const MapObservation& seen) {
    FrameVector own = FrameVector::Zero();
    own.tail<kViewTerms>() = frame.view;
    return view.residual(seen) + terms.change(own, shared_terms(own, solution.camera)) -
           view.page_from_camera().transpose() * solution.offset_mm[seen.index()].cast<double>();
}

/// Returns the median of the squares, or of a sample of about a million squares if there are more.
double typical_square(const std::vector<float>& squares) {
    constexpr std::size_t kMaxSamples = 1'000'000;
    const std::size_t step = 1 + squares.size() / kMaxSamples;
    std::vector<double> samples;
    for (std::size_t i = 0; i < squares.size(); i += step)
        samples.push_back(double(squares[i]));
    return upper_median(std::move(samples));
}

/// Computes the squared residuals of a frame, and adds the squares that are not outliers to `sum`.
/// Returns the view terms fitted to this frame only.
FreeView measure_frame(const MapGrid& grid, const MapSolution& solution, const MapFrame& frame,
                       const std::vector<MapObservation>& observations, std::vector<float>& squares,
                       double& sum) {
    const MapView view(grid, frame, solution.reach_mm);
    FrameBlock block = FrameBlock::Zero();
    FrameVector right = FrameVector::Zero();
    double unused = 0;
    double own = 0;
    for (std::size_t i = frame.first; i < frame.first + frame.count; ++i) {
        const MapView::Terms terms = view.terms(observations[i]);
        const Vector2d residual = residual_of(view, terms, solution, frame, observations[i]);
        squares[i] = static_cast<float>(residual.squaredNorm());
        if (observations[i].is_outlier()) continue;
        const auto derivatives = terms.derivatives();
        block.noalias() += derivatives.transpose() * derivatives;
        terms.add_transposed(residual, right, unused);
        own += residual.squaredNorm();
    }
    sum += own;
    return free_view(block, right, frame, own / (2 * static_cast<double>(frame.count)));
}

/// Computes the statistics, then marks the outliers again: observations whose squared residual
/// exceeds `limit` times the typical variance per axis.
Statistics measure(const MapGrid& grid, double limit, MapSolution& solution,
                   std::vector<MapObservation>& observations) {
    std::vector<float> squares(observations.size());
    std::vector<FreeView> views(solution.frames.size());
    std::array<double, kMapParts> sums{};
    for_each_item(views.size(), [&](int part, std::size_t f) {
        views[f] = measure_frame(grid, solution, solution.frames[f], observations, squares,
                                 sums[static_cast<std::size_t>(part)]);
    });
    Statistics result;
    result.squares = std::accumulate(sums.begin(), sums.end(), 0.0);
    result.view_sigma = view_sigma_of(views);
    const double max_square = limit * typical_square(squares) / kMedianOfSquaredLength;
    std::ranges::fill(solution.views, 0);
    solution.outliers = 0;
    for (std::size_t i = 0; i < observations.size(); ++i) {
        const std::uint32_t dot = observations[i].index();
        const bool is_outlier = double(squares[i]) > max_square;
        observations[i].dot = dot | (is_outlier ? MapObservation::kOutlier : 0);
        solution.outliers += is_outlier ? 1 : 0;
        solution.views[dot] += is_outlier ? 0 : 1;
    }
    return result;
}

/// Estimates noise and jitter. `used` is the number of observations that are not outliers, and
/// `squares` is the sum of their squared residuals.
void estimate_variances(const MapGrid& grid, double squares, std::size_t used,
                        MapSolution& solution) {
    const double weight = 1 / (solution.noise_mm * solution.noise_mm);
    const double prior = 1 / (solution.jitter_mm * solution.jitter_mm);
    double fitted = kFrameTerms * static_cast<double>(solution.frames.size());
    double jitter = 0;
    std::size_t seen = 0;
    for (std::size_t i = 0; i < grid.dots(); ++i) {
        if (solution.views[i] == 0) continue;
        const double own = weight * solution.views[i];
        fitted += 2 * own / (own + prior);
        const auto columns = static_cast<std::size_t>(grid.columns);
        const Vector2d mean =
            solution.field.at(static_cast<int>(i % columns), static_cast<int>(i / columns));
        jitter +=
            (solution.offset_mm[i].cast<double>() - mean).squaredNorm() / 2 + 1 / (own + prior);
        ++seen;
    }
    const double free = std::max(2 * static_cast<double>(used) - fitted, 1.0);
    solution.noise_mm = std::max(std::sqrt(squares / free), kMinNoise_mm);
    solution.jitter_mm = std::max(
        std::sqrt(jitter / static_cast<double>(std::max<std::size_t>(seen, 1))), kMinJitter_mm);
}

/// Removes the mean shift, scale and rotation from all offsets, because views of the page do not
/// determine them. Fits a similarity (shift, scale and rotation) to the offsets of the observed
/// dots, and applies its inverse to the positions of all dots. The position of a dot includes its
/// displacement and its offset, because both rotate with the page. For example, a rotation by 0.003
/// rad changes the 40 µm offsets of a feed wave by 0.13 µm, and moves a dot with a displacement of
/// 85 µm by 0.26 µm.
void fix_gauge(const MapGrid& grid, MapSolution& solution) {
    const Vector2d middle =
        grid.pitch_mm.cwiseProduct(Vector2d(grid.columns - 1, grid.rows - 1)) / 2;
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    const auto rows_of = [](const Vector2d& at) {
        Eigen::Matrix<double, 2, 4> rows;
        rows << 1, 0, at.x(), -at.y(), 0, 1, at.y(), at.x();
        return rows;
    };
    for (std::size_t i = 0; i < grid.dots(); ++i) {
        if (solution.views[i] == 0) continue;
        const auto rows = rows_of(grid.place_mm(i) - middle);
        normal += rows.transpose() * rows;
        right += rows.transpose() * solution.offset_mm[i].cast<double>();
    }
    const Eigen::Vector4d gauge = normal.ldlt().solve(right);
    Eigen::Matrix2d similarity;
    similarity << 1 + gauge[2], -gauge[3], gauge[3], 1 + gauge[2];
    const Eigen::Matrix2d inverse = similarity.inverse();
    double displacement_mm = 0;
    for (const MapFrame& frame : solution.frames)
        displacement_mm += frame.displacement_mm / static_cast<double>(solution.frames.size());
    for (std::size_t i = 0; i < grid.dots(); ++i) {
        const Vector2d from_middle = grid.place_mm(i, displacement_mm) - middle;
        const Vector2d place = from_middle + solution.offset_mm[i].cast<double>() - gauge.head<2>();
        solution.offset_mm[i] = (inverse * place - from_middle).cast<float>();
    }
}

}  // namespace

void solve_map(const MapGrid& grid, const EarlierOffsets& earlier, double reach_mm,
               std::vector<MapObservation>& observations, MapSolution& solution,
               const MapProgress& progress) {
    solution.reach_mm = reach_mm;
    solution.field = MapField(grid.columns, grid.rows, grid.pitch_mm.mean());
    solution.offset_mm.assign(grid.dots(), Eigen::Vector2f::Zero());
    if (!earlier.offset_mm.empty()) solution.offset_mm = earlier.offset_mm;
    solution.views.assign(grid.dots(), 0);
    solution.noise_mm = kFirstNoise * grid.pitch_mm.mean();
    solution.jitter_mm = kFirstJitter * grid.pitch_mm.mean();
    solution.view_sigma = measure(grid, kFirstOutlier, solution, observations).view_sigma;
    for (int round = 0; round < kRounds; ++round) {
        MapSystem system(grid, earlier, observations, solution);
        system.solve(solution, round == kRounds - 1 ? kConverged : kFirstConverged,
                     [&](double fraction) { progress((round + fraction) / kRounds); });
        if (round == kRounds - 1) {
            solution.errors = map_errors(grid, solution, system.deformation(),
                                         earlier.views.empty() ? Gauge::fixed : Gauge::earlier);
        }
        const std::size_t used = observations.size() - solution.outliers;
        const Statistics now = measure(grid, kMaxSquaredLength, solution, observations);
        estimate_variances(grid, now.squares, used, solution);
        solution.view_sigma = now.view_sigma;
    }
    if (earlier.views.empty()) fix_gauge(grid, solution);
}

}  // namespace dotpose::calibrate
