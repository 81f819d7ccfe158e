#include "map_input.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "calibrate/map_start.hpp"

namespace dotpose::test {
namespace {

using calibrate::MapFrame;
using calibrate::MapGrid;
using calibrate::MapSolution;
using Eigen::Vector2d;

constexpr double kDotNoise_mm = 0.00137;  ///< standard deviation of a measured position, per axis

/// Adds a frame: the measured positions of the dots in its view, and an approximate pose.
void add_frame(const MappedPrint::Pose& pose, Vector2d half_view_mm, Rng& rng, SolverInput& input) {
    const MapGrid& grid = input.grid;
    const double pitch = grid.pitch_mm.x();
    const double displacement = pitch / 6;
    const Vector2d centre(pose.at_mm.x, pose.at_mm.y);
    const double c = std::cos(pose.theta_rad);
    const double s = std::sin(pose.theta_rad);
    MapFrame frame{.first = input.observations.size()};
    const auto first = [&](double at) { return std::max(int((at - input.reach_mm) / pitch), 0); };
    const auto last = [&](double at, int count) {
        return std::min(int((at + input.reach_mm) / pitch) + 1, count - 1);
    };
    for (int j = first(centre.y()); j <= last(centre.y(), grid.rows); ++j) {
        for (int i = first(centre.x()); i <= last(centre.x(), grid.columns); ++i) {
            const auto dot = static_cast<std::size_t>(j * grid.columns + i);
            const Vector2d off = grid.place_mm(dot, displacement) + input.offsets_mm[dot] - centre;
            const Vector2d seen(c * off.x() + s * off.y(), c * off.y() - s * off.x());
            if ((seen.cwiseAbs().array() > half_view_mm.array()).any()) continue;
            input.observations.push_back(
                {static_cast<std::uint32_t>(dot),
                 static_cast<float>(seen.x() + kDotNoise_mm * rng.normal()),
                 static_cast<float>(seen.y() + kDotNoise_mm * rng.normal())});
        }
    }
    frame.count = input.observations.size() - frame.first;
    frame.place_mm = centre + 0.02 * Vector2d(rng.normal(), rng.normal());
    frame.angle_rad = pose.theta_rad + 1e-3 * rng.normal();
    frame.displacement_mm = displacement;
    input.start.frames.push_back(frame);
}

}  // namespace

SolverInput simulated_input(const MappedPrint& print, std::uint64_t frames, std::uint64_t seed) {
    SolverInput input;
    input.grid = calibrate::grid_of(print.entry());
    Rng rng(seed);
    for (std::size_t i = 0; i < input.grid.dots(); ++i) {
        const Vector2d at = input.grid.place_mm(i);
        const Vec2 wave = print.wave({at.x(), at.y()});
        const double jitter_mm = print.options().jitter_mm;
        input.offsets_mm.emplace_back(wave.x + jitter_mm * rng.normal(),
                                      wave.y + jitter_mm * rng.normal());
    }
    constexpr double kBorder_mm = 0.15;  // minimum distance of a measured dot from the image border
    const Vector2d half_view_mm =
        CameraModel{}.mm_per_px / 2 *
            Vector2d(print.options().width_px, print.options().height_px) -
        Vector2d::Constant(kBorder_mm);
    input.reach_mm = half_view_mm.norm();
    for (std::uint64_t i = 0; i < frames; ++i)
        add_frame(print.pose(seed + 95, i), half_view_mm, rng, input);
    return input;
}

std::vector<Vector2d> offset_errors_mm(const SolverInput& input, const MapSolution& solution) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    std::vector<Vector2d> errors;
    const auto rows_of = [&](std::size_t dot) {
        const Vector2d at = input.grid.place_mm(dot) / 100;
        Eigen::Matrix<double, 2, 4> rows;
        rows << 1, 0, at.x(), -at.y(), 0, 1, at.y(), at.x();
        return rows;
    };
    for (std::size_t i = 0; i < input.grid.dots(); ++i) {
        errors.emplace_back(solution.offset_mm[i].cast<double>() - input.offsets_mm[i]);
        if (solution.views[i] == 0) continue;
        normal += rows_of(i).transpose() * rows_of(i);
        right += rows_of(i).transpose() * errors[i];
    }
    const Eigen::Vector4d similarity = normal.ldlt().solve(right);
    for (std::size_t i = 0; i < errors.size(); ++i)
        errors[i] -= rows_of(i) * similarity;
    return errors;
}

}  // namespace dotpose::test
