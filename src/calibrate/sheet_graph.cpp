#include "calibrate/sheet_graph.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <utility>

#include <Eigen/LU>
#include <ceres/ceres.h>

#include "calibrate/least_squares.hpp"
#include "calibrate/normal_inverse.hpp"

namespace dotpose::calibrate {
namespace {

/// If the whitened residual of a view (scaled to a standard deviation of 1) exceeds this limit, the
/// weight of the view is reduced. One view in 70 exceeds the limit by chance.
constexpr double kRobust_sigmas = 4;
/// Standard deviation of a prior that effectively fixes a parameter.
constexpr double kPinned = 1e-7;
/// Prior relative standard deviation of the camera scale.
constexpr double kCameraPrior = 0.03;
/// Prior standard deviation of the aspect and of the skew, for a camera file that contains no
/// standard deviations for them. The value is small because sensor pixels are nearly square.
constexpr double kSquarePrior = 0.002;

/// Vector in the plane. T is double or an automatic differentiation type.
template <typename T>
struct Vector {
    T x;
    T y;
};

template <typename T>
Vector<T> turned(const T& angle, const Vector<T>& v) {
    using std::cos;
    using std::sin;
    const T c = cos(angle);
    const T s = sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// Computes the whitened residuals of a view from the parameters of the camera, the frame and the
/// sheet.
struct ViewResidual {
    const SheetView& view;
    /// Position of the sheet's first intersection relative to the corner of the page.
    Eigen::Vector2d first_mm;

    template <typename T>
    bool operator()(const T* camera, const T* frame, const T* sheet, T* residual) const {
        using std::exp;
        const T scale = exp(camera[0]);
        const auto true_mm = [&](double x, double y) {
            return Vector<T>{scale * ((1.0 + camera[1]) * x + camera[2] * y),
                             scale * (1.0 - camera[1]) * y};
        };
        const T per_print_x = exp(-sheet[3]);
        const T per_print_y = exp(-sheet[4]);
        const Vector<T> seen = turned(frame[2], true_mm(view.middle.x(), view.middle.y()));
        const Vector<T> on_page =
            turned<T>(-sheet[2], {frame[0] + seen.x - sheet[0], frame[1] + seen.y - sheet[1]});
        const T turn = frame[2] - sheet[2];
        const Vector<T> x_axis = turned(turn, true_mm(1, 0));
        const Vector<T> y_axis = turned(turn, true_mm(0, 1));
        const T off[6] = {per_print_x * (on_page.x - first_mm.x()) - view.place.x(),
                          per_print_y * (on_page.y - first_mm.y()) - view.place.y(),
                          per_print_x * x_axis.x - view.axes(0, 0),
                          per_print_y * x_axis.y - view.axes(1, 0),
                          per_print_x * y_axis.x - view.axes(0, 1),
                          per_print_y * y_axis.y - view.axes(1, 1)};
        for (int i = 0; i < 6; ++i) {
            residual[i] = T(0);
            for (int j = 0; j < 6; ++j)
                residual[i] += view.whitening(i, j) * off[j];
        }
        return true;
    }
};

/// Residual of a constraint: (sum of weights * parameters - expected) / sigma.
template <int kSize>
struct Pin {
    std::array<double, kSize> weights;
    double expected;
    double sigma;

    template <typename T>
    bool operator()(const T* parameters, T* residual) const {
        residual[0] = T(-expected);
        for (std::size_t i = 0; i < kSize; ++i)
            residual[0] += weights[i] * parameters[i];
        residual[0] /= sigma;
        return true;
    }
};

template <std::size_t kSize>
void pin(ceres::Problem& problem, std::array<double, kSize>& block,
         const std::array<double, kSize>& weights, double expected, double sigma) {
    constexpr int kCount = static_cast<int>(kSize);
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Pin<kCount>, 1, kCount>(
                                 new Pin<kCount>{weights, expected, sigma}),
                             nullptr, block.data());
}

template <std::size_t kSize>
void pin_one(ceres::Problem& problem, std::array<double, kSize>& block, std::size_t index,
             double expected, double sigma) {
    std::array<double, kSize> weights{};
    weights[index] = 1;
    pin(problem, block, weights, expected, sigma);
}

/// Converts the point `in_camera` and the direction of the x axis from the camera frame to the page
/// frame of the sheet that `view` shows.
PlanePose on_page(const SheetView& view, const Eigen::Vector2d& in_camera, const Sheet& sheet,
                  const AxisScale& scale) {
    const Eigen::Vector2d at = view.place + view.axes * (in_camera - view.middle);
    return {sheet.origin_x_mm + scale.x * at.x(), sheet.origin_y_mm + scale.y * at.y(),
            std::atan2(scale.y * view.axes(1, 0), scale.x * view.axes(0, 0))};
}

/// Returns the relative standard deviation of a value in the camera file, or 0 if the file contains
/// no standard deviation for this value.
double relative_sigma(const Camera& camera, const char* key, double value) {
    const auto found = camera.sigma.find(key);
    return found == camera.sigma.end() ? 0 : found->second / value;
}

}  // namespace

PlanePose PlanePose::operator*(const PlanePose& inner) const {
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    return {x + c * inner.x - s * inner.y, y + s * inner.x + c * inner.y, turn + inner.turn};
}

PlanePose PlanePose::inverse() const {
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    return {-c * x - s * y, s * x - c * y, -turn};
}

SheetGraph::SheetGraph(const std::vector<SheetEntry>& sheets, const std::optional<Camera>& camera,
                       std::vector<SheetView> views, std::size_t fixed,
                       const ScaleReference& reference)
    : sheets_(sheets),
      camera_(camera),
      views_(std::move(views)),
      fixed_(fixed),
      reference_(reference),
      nodes_(sheets.size()),
      variances_(sheets.size()) {}

void SheetGraph::solve() {
    spread_from_fixed();
    start_frames();
    fit();
}

PlanePose SheetGraph::pose(std::size_t sheet) const {
    const Node& node = nodes_[sheet].value();
    return {node[0], node[1], node[2]};
}

AxisScale SheetGraph::print_scale(std::size_t sheet) const {
    const Node& node = nodes_[sheet].value();
    return {std::exp(node[3]), std::exp(node[4])};
}

double SheetGraph::sigma_mm(std::size_t sheet) const {
    return std::sqrt((variances_[sheet][0] + variances_[sheet][1]) / 2);
}

double SheetGraph::sigma_rad(std::size_t sheet) const {
    return std::sqrt(variances_[sheet][2]);
}

AxisScale SheetGraph::sigma_scale(std::size_t sheet) const {
    const AxisScale scale = print_scale(sheet);
    return {scale.x * std::sqrt(variances_[sheet][3]), scale.y * std::sqrt(variances_[sheet][4])};
}

bool SheetGraph::has_scale() const {
    return std::ranges::any_of(views_, &SheetView::has_scale);
}

/// Returns the image centre in the camera coordinate frame of the view.
Eigen::Vector2d SheetGraph::centre_in_camera(const SheetView& view) const {
    if (!view.has_scale()) return {0, 0};
    const CameraPoint point =
        on_paper(*camera_, {(camera_->width_px - 1) / 2.0, (camera_->height_px - 1) / 2.0});
    return {point.x_mm, point.y_mm};
}

Eigen::Vector2d SheetGraph::centre_on_sheet(const SheetView& view) const {
    return view.place + view.axes * (centre_in_camera(view) - view.middle);
}

PlanePose SheetGraph::image_centre(const SheetView& view) const {
    return pose(view.sheet) * on_page(view, centre_in_camera(view), sheets_[view.sheet].sheet,
                                      print_scale(view.sheet));
}

/// Sets initial poses of the sheets by a breadth-first search from the fixed sheet. If several
/// frames show the same two sheets, uses the frame that maximises the smaller of the two dot
/// counts.
void SheetGraph::spread_from_fixed() {
    const auto start = [this](std::size_t sheet, const PlanePose& pose) {
        const AxisScale scale = sheets_[sheet].print_scale();
        nodes_[sheet] = {pose.x, pose.y, pose.turn, std::log(scale.x), std::log(scale.y)};
    };
    const auto seen_on = [this](const SheetView& view) {
        const SheetEntry& entry = sheets_[view.sheet];
        return on_page(view, {0, 0}, entry.sheet, entry.print_scale());
    };
    start(fixed_, {});
    std::deque<std::size_t> open{fixed_};
    while (!open.empty()) {
        const std::size_t from = open.front();
        open.pop_front();
        std::map<std::size_t, std::pair<std::size_t, PlanePose>> best;
        for (const SheetView& near : views_) {
            for (const SheetView& far : views_) {
                if (near.sheet != from || far.frame != near.frame) continue;
                if (is_connected(far.sheet)) continue;
                const std::size_t dots = std::min(near.dots.size(), far.dots.size());
                auto& candidate = best[far.sheet];
                if (dots <= candidate.first) continue;
                candidate = {dots, pose(from) * seen_on(near) * seen_on(far).inverse()};
            }
        }
        for (const auto& [sheet, candidate] : best) {
            start(sheet, candidate.second);
            open.push_back(sheet);
        }
    }
}

/// Sets initial poses of the frames. Removes views that do not affect the poses of sheets.
void SheetGraph::start_frames() {
    std::map<int, int> counts;
    std::erase_if(views_, [this](const SheetView& view) { return !is_connected(view.sheet); });
    for (const SheetView& view : views_)
        ++counts[view.frame];
    std::erase_if(
        views_, [&](const SheetView& view) { return !view.has_scale() && counts[view.frame] < 2; });
    for (const SheetView& view : views_) {
        const PlanePose found = pose(view.sheet) * on_page(view, {0, 0}, sheets_[view.sheet].sheet,
                                                           print_scale(view.sheet));
        frames_[view.frame] = {found.x, found.y, found.turn};
    }
}

void SheetGraph::fit() {
    ceres::Problem problem;
    add_views(problem);
    pin_sheets(problem);
    pin_camera(problem);
    ceres::Solver::Options options;
    options.logging_type = ceres::SILENT;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.function_tolerance = 1e-12;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    estimate_variances(problem, summary.final_cost);
}

void SheetGraph::add_views(ceres::Problem& problem) {
    for (const SheetView& view : views_) {
        const Sheet& sheet = sheets_[view.sheet].sheet;
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<ViewResidual, 6, 3, 3, 5>(
                new ViewResidual{view, {sheet.origin_x_mm, sheet.origin_y_mm}}),
            new ceres::HuberLoss(kRobust_sigmas), camera_scale_.data(), frames_[view.frame].data(),
            nodes_[view.sheet]->data());
    }
}

void SheetGraph::pin_sheets(ceres::Problem& problem) {
    using By = ScaleReference::By;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (!is_connected(i)) continue;
        Node& node = *nodes_[i];
        const AxisScale file = sheets_[i].print_scale();
        const std::array logs = {std::log(file.x), std::log(file.y)};
        for (std::size_t axis = 0; axis < 2; ++axis)
            pin_one(problem, node, 3 + axis, logs[axis], kUsualPrintError);
        if (i == fixed_) {
            for (std::size_t k = 0; k < 3; ++k)
                pin_one(problem, node, k, 0, kPinned);
        }
        if (i == fixed_ && !has_scale()) {
            // Fixes the aspect to its value in the sheet file. Views computed from parts of frames
            // contain information about the aspect, but they all have the same error, so the error
            // would not average out.
            pin<5>(problem, node, {0, 0, 0, 1, -1}, logs[0] - logs[1], kPinned);
        }
        if (i == fixed_ && reference_.by == By::fixed_sheet) {
            pin<5>(problem, node, {0, 0, 0, 0.5, 0.5}, (logs[0] + logs[1]) / 2, kPinned);
        }
        if (reference_.by == By::width && sheets_[i].name == reference_.sheet) {
            const Sheet& sheet = sheets_[i].sheet;
            const double nominal_mm = (sheet.columns - 1) * sheet.pattern.spacing_mm;
            pin_one(problem, node, 3, std::log(reference_.width_mm / nominal_mm), kPinned);
        }
    }
}

void SheetGraph::pin_camera(ceres::Problem& problem) {
    if (!has_scale()) {
        problem.SetParameterBlockConstant(camera_scale_.data());
        return;
    }
    const Camera& camera = *camera_;
    const double x = relative_sigma(camera, "mm_per_px_x", camera.paper->mm_per_px_x);
    const double y = relative_sigma(camera, "mm_per_px_y", camera.paper->mm_per_px_y);
    // Standard deviation of the mean of the two scales, and also of half their difference.
    const double half = std::hypot(x, y) / 2;
    const double skew = relative_sigma(camera, "skew", 1);
    const bool is_true = reference_.by == ScaleReference::By::camera;
    pin_one(problem, camera_scale_, 0, 0, is_true ? std::max(half, kPinned) : kCameraPrior);
    pin_one(problem, camera_scale_, 1, 0, half > 0 ? half : kSquarePrior);
    pin_one(problem, camera_scale_, 2, 0, skew > 0 ? skew : kSquarePrior);
}

/// Returns the DotDerivative of each dot. Assumes that the view was computed by fitting an affine
/// map to all dots. The derivatives are scaled so that dot errors with standard deviation 1 cause
/// whitened residuals with standard deviation 1.
std::vector<SheetGraph::DotDerivative> SheetGraph::dot_derivatives(const SheetView& view) const {
    const Pattern& pattern = sheets_[view.sheet].sheet.pattern;
    const Cell first = sheets_[view.sheet].sheet.origin;
    const Eigen::Matrix2d camera_from_sheet = view.axes.inverse();
    std::vector<std::array<double, 3>> places;  // 1, x, y in the camera frame
    NormalEquations equations(3);               // fit of an affine map along one axis
    for (const std::uint64_t dot : view.dots) {
        const Eigen::Vector2d steps(static_cast<double>((dot >> 32) - first.x),
                                    static_cast<double>((dot & 0xffffffff) - first.y));
        const Eigen::Vector2d at = camera_from_sheet * (pattern.spacing_mm * steps - view.place);
        equations.add(places.emplace_back(std::array{1.0, at.x(), at.y()}), 0);
    }
    const Eigen::MatrixXd along_axis = equations.unit_covariance();
    // Covariance of place and axes, column by column. The errors along x and y are independent.
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(6, 6);
    for (Eigen::Index i = 0; i < 6; ++i) {
        for (Eigen::Index j = i % 2; j < 6; j += 2)
            covariance(i, j) = along_axis(i / 2, j / 2);
    }
    const Eigen::MatrixXd known = view.whitening.topRows(view.rows);
    const Eigen::MatrixXd scaled = whitening_of(propagated(known, covariance)) * known;
    std::vector<DotDerivative> derivatives;
    for (const auto& place : places) {
        DotDerivative& derivative = derivatives.emplace_back(DotDerivative::Zero());
        for (Eigen::Index k = 0; k < 3; ++k) {
            const double fitted = along_axis(k, 0) * place[0] + along_axis(k, 1) * place[1] +
                                  along_axis(k, 2) * place[2];
            derivative.topRows(view.rows) += fitted * scaled.middleCols<2>(2 * k);
        }
    }
    return derivatives;
}

/// Returns the variances of the shared parameters due to printing errors. A dot has the same
/// printing error in all frames that show it.
Eigen::VectorXd SheetGraph::print_variances(const Eigen::MatrixXd& gain) const {
    std::map<std::pair<std::size_t, std::uint64_t>, Eigen::MatrixX2d> of_dots;
    Eigen::Index row = 0;
    for (const SheetView& view : views_) {
        const std::vector<DotDerivative> derivatives = dot_derivatives(view);
        for (std::size_t i = 0; i < derivatives.size(); ++i) {
            const auto [dot, is_new] = of_dots.try_emplace({view.sheet, view.dots[i]});
            if (is_new) dot->second.setZero(gain.rows(), 2);
            dot->second += gain.middleCols<6>(row) * derivatives[i];
        }
        row += 6;
    }
    Eigen::VectorXd variances = Eigen::VectorXd::Zero(gain.rows());
    for (const auto& [dot, moves] : of_dots)
        variances += moves.rowwise().squaredNorm();
    return variances;
}

void SheetGraph::estimate_variances(ceres::Problem& problem, double cost) {
    std::vector<double*> shared;
    for (auto& node : nodes_) {
        if (node) shared.push_back(node->data());
    }
    int residuals = problem.NumResiduals() - 6 * static_cast<int>(views_.size());
    for (const SheetView& view : views_)
        residuals += view.rows;
    const int parameters =
        problem.NumParameters() - (has_scale() ? 0 : static_cast<int>(camera_scale_.size()));
    if (has_scale()) shared.push_back(camera_scale_.data());
    // Factor by which the print variances are multiplied: the sum of squared residuals divided by
    // the number of degrees of freedom, but at least 1. The sum includes the effect of bent sheets,
    // which the residuals within a single frame do not show.
    const double misfit = std::max(2 * cost / std::max(residuals - parameters, 1), 1.0);
    const Eigen::MatrixXd gain = normal_gain(problem, shared);
    const auto pins = gain.rightCols(gain.cols() - 6 * static_cast<Eigen::Index>(views_.size()));
    const Eigen::VectorXd variances = misfit * print_variances(gain) + pins.rowwise().squaredNorm();
    Eigen::Index row = 0;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (!nodes_[i]) continue;
        for (double& variance : variances_[i]) {
            variance = variances[row];
            ++row;
        }
        if (has_scale()) continue;
        // Adds the variance of the fixed sheet's print scale, because all scales are relative to
        // this sheet.
        for (const std::size_t scale : {3, 4})
            variances_[i][scale] += kUsualPrintError * kUsualPrintError;
    }
}

}  // namespace dotpose::calibrate
