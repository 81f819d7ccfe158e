// Compares the errors of print maps with the covariances that the maps contain (docs/print-map.md).
// Each map is solved from simulated dots. Its offsets are compared with the true offsets in views
// distributed over the page.
//
//   dotpose_tables print_map_errors [--maps N] [--update DOCUMENT]
//
// The exit status is 1 if a mean of error^2 / variance is not between 0.8 and 1.25.
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/LU>
#include <fmt/core.h>

#include "../tests/map_input.hpp"
#include "dotpose/files/degrees.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

struct MapKind {
    int width_mm;
    int height_mm;
    int width_px;
    int height_px;
    std::uint64_t frames;
};
constexpr std::array kMapKinds{MapKind{60, 60, 320, 240, 500}, MapKind{120, 60, 320, 240, 1000},
                               MapKind{200, 150, 320, 240, 2400},
                               MapKind{210, 297, 640, 480, 2000}};
constexpr std::array kRange{0.8, 1.25};

/// Sums over all views of all maps.
struct MapErrorSums {
    Vector3d squares = Vector3d::Zero();  ///< squared errors
    Vector3d variances = Vector3d::Zero();
    Vector3d ratios = Vector3d::Zero();
    int views = 0;

    void add(const Vector3d& error, const Vector3d& variance) {
        squares += error.cwiseAbs2();
        variances += variance;
        ratios += error.cwiseAbs2().cwiseQuotient(variance);
        ++views;
    }
    Vector3d ratio() const { return ratios / views; }
    std::string text() const {
        const Vector3d error = (squares / views).cwiseSqrt();
        const Vector3d sigma = (variances / views).cwiseSqrt();
        return fmt::format(
            "{:.3f} / {:.3f} / {:.5f} | {:.3f} / {:.3f} / {:.5f} | {:.2f} / {:.2f} / {:.2f}",
            1000 * error.x(), 1000 * error.y(), kDegrees * error.z(), 1000 * sigma.x(),
            1000 * sigma.y(), kDegrees * sigma.z(), ratio().x(), ratio().y(), ratio().z());
    }
};

/// Error of a map in one view: the shift, in mm, and the turn, in radians.
struct ViewError {
    Vector3d error;
    /// Variances due to the independent errors of the dots. The map does not contain these
    /// variances, because a fix estimates them from its residuals.
    Vector3d of_dots;
};

ViewError error_in_view(const test::SolverInput& input, const std::vector<Vector2d>& errors,
                        const test::MappedPrint::Pose& pose, Vector2d half_view_mm) {
    const double weight = 1 / (input.start.noise_mm * input.start.noise_mm);
    const double prior = 1 / (input.start.jitter_mm * input.start.jitter_mm);
    double variance = 0;
    double dots = 0;
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    const double c = std::cos(pose.theta_rad);
    const double s = std::sin(pose.theta_rad);
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const Vector2d off = input.grid.place_mm(i) - Vector2d(pose.at_mm.x, pose.at_mm.y);
        const Vector2d seen(c * off.x() + s * off.y(), c * off.y() - s * off.x());
        if ((seen.cwiseAbs().array() > half_view_mm.array()).any()) continue;
        Eigen::Matrix<double, 2, 4> rows;
        rows << 1, 0, -off.y(), off.x(), 0, 1, off.x(), off.y();
        normal += rows.transpose() * rows;
        right += rows.transpose() * errors[i];
        variance += 1 / (weight * input.start.views[i] + prior);
        dots += 1;
    }
    const Eigen::Matrix4d inverse = normal.inverse();
    return {(inverse * right).head<3>(), variance / dots * inverse.diagonal().head<3>()};
}

/// Returns the covariance at the map node nearest to `at_mm`.
Matrix3d covariance_at(const test::SolverInput& input, const Vec2& at_mm) {
    const calibrate::MapErrorGrid& errors = input.start.errors;
    const Vector2d size =
        input.grid.pitch_mm.cwiseProduct(Vector2d(input.grid.columns - 1, input.grid.rows - 1));
    const auto i = std::lround(at_mm.x / size.x() * (errors.columns - 1));
    const auto j = std::lround(at_mm.y / size.y() * (errors.rows - 1));
    return errors.covariances[static_cast<std::size_t>(j * errors.columns + i)];
}

void add_map(const MapKind& kind, std::uint64_t seed, MapErrorSums& sums) {
    const test::MappedPrint print({.side_mm = double(kind.width_mm),
                                   .height_mm = double(kind.height_mm),
                                   .width_px = kind.width_px,
                                   .height_px = kind.height_px});
    test::SolverInput input = test::simulated_input(print, kind.frames, seed);
    solve_map(input.grid, {}, input.reach_mm, input.observations, input.start, [](double) {
        if (cli::interrupted()) throw Error("interrupted");
    });
    const std::vector<Vector2d> errors = test::offset_errors_mm(input, input.start);
    const Vector2d half_view_mm =
        CameraModel{}.mm_per_px / 2 * Vector2d(kind.width_px, kind.height_px);
    constexpr std::uint64_t kViews = 100;
    for (std::uint64_t i = 0; i < kViews; ++i) {
        const test::MappedPrint::Pose pose = print.pose(seed + 1000, i);
        const auto [error, of_dots] = error_in_view(input, errors, pose, half_view_mm);
        sums.add(error, covariance_at(input, pose.at_mm).diagonal() + of_dots);
    }
}

}  // namespace

bool print_map_errors_table(TableRun& run) {
    std::uint64_t maps = 10;
    run.add_count("--maps", maps, "Number of maps in each row");
    run.add_update();
    if (!run.parse()) return true;
    std::string text =
        "| page, mm | image, px | frames | maps | error of a view, rms: x, y, µm, turn, degrees | "
        "standard "
        "deviation in the map | error² / variance |\n|---|---|--:|--:|---|---|---|\n";
    bool is_right = true;
    for (const MapKind& kind : kMapKinds) {
        MapErrorSums sums;
        for (std::uint64_t i = 0; i < maps; ++i) {
            cli::ProgressLine line("maps");
            line.update(static_cast<std::int64_t>(i), static_cast<std::int64_t>(maps));
            add_map(kind, 5 + i, sums);
        }
        text += fmt::format("| {} x {} | {} x {} | {} | {} | {} |\n", kind.width_mm, kind.height_mm,
                            kind.width_px, kind.height_px, kind.frames, maps, sums.text());
        const auto ratio = sums.ratio().array();
        is_right &= (ratio >= kRange[0]).all() && (ratio <= kRange[1]).all();
    }
    run.print_block("print-map-errors", text);
    run.update_document();
    return is_right;
}

}  // namespace dotpose::tables
