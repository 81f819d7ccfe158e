// Measures the processor time and the memory of the solver of print maps (docs/print-map.md), for
// frames of 640 x 480 px that show an A4 page. The dots of the frames are computed directly,
// because rendering all images would take hours.
//
//   dotpose_tables print_map_solver [--frames N]
//
// The processor time is the sum over all threads, so other programs on the machine hardly affect
// it. The exit status is 1 if the solver takes more than 10 minutes, which are 5 minutes on two
// cores, or uses more than 2 GB of memory.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <vector>

#include <Eigen/Cholesky>
#include <fmt/core.h>
#include <sys/resource.h>

#include "../tests/mapped_print.hpp"
#include "calibrate/map_start.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

using calibrate::MapFrame;
using calibrate::MapGrid;
using calibrate::MapObservation;
using calibrate::MapSolution;
using Eigen::Vector2d;

constexpr double kDotNoise_mm = 0.00137;  ///< standard deviation per axis, in a nominal frame

/// A page whose dots have known offsets, and the dots that each frame of the page shows.
struct SolverInput {
    MapGrid grid;
    std::vector<Vector2d> offsets_mm;  ///< true offsets of the dots
    std::vector<MapObservation> observations;
    MapSolution start;  ///< contains approximate poses of the frames
    double reach_mm = 0;
};

/// Adds a frame with the dots in its view, and an approximate pose.
void add_frame(const test::MappedPrint::Pose& pose, Vector2d half_view_mm, Rng& rng,
               SolverInput& input) {
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

SolverInput simulated_input(std::uint64_t frames) {
    const test::MappedPrint print(
        {.side_mm = 210, .height_mm = 297, .width_px = 640, .height_px = 480});
    SolverInput input;
    input.grid = calibrate::grid_of(print.entry());
    Rng rng(5);
    for (std::size_t i = 0; i < input.grid.dots(); ++i) {
        const Vector2d at = input.grid.place_mm(i);
        const Vec2 wave = print.wave({at.x(), at.y()});
        const double jitter_mm = print.options().jitter_mm;
        input.offsets_mm.emplace_back(wave.x + jitter_mm * rng.normal(),
                                      wave.y + jitter_mm * rng.normal());
    }
    constexpr double kBorder_mm = 0.15;  // dots closer to the image border are not measured
    const Vector2d half_view_mm =
        CameraModel{}.mm_per_px * Vector2d(320, 240) - Vector2d::Constant(kBorder_mm);
    input.reach_mm = half_view_mm.norm();
    for (std::uint64_t i = 0; i < frames; ++i)
        add_frame(print.pose(100, i), half_view_mm, rng, input);
    return input;
}

/// Returns the rms error of the offsets per axis, in µm. Errors of the place, turn and scale of the
/// whole page are not included, because frames do not determine them.
double offset_error_um(const SolverInput& input, const MapSolution& solution) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    double squares = 0;
    double count = 0;
    for (std::size_t i = 0; i < input.grid.dots(); ++i) {
        if (solution.views[i] == 0) continue;
        const Vector2d at = input.grid.place_mm(i) / 100;
        const Vector2d error = solution.offset_mm[i].cast<double>() - input.offsets_mm[i];
        Eigen::Matrix<double, 2, 4> rows;
        rows << 1, 0, at.x(), -at.y(), 0, 1, at.y(), at.x();
        normal += rows.transpose() * rows;
        right += rows.transpose() * error;
        squares += error.squaredNorm();
        count += 2;
    }
    return 1000 * std::sqrt((squares - right.dot(normal.ldlt().solve(right))) / count);
}

}  // namespace

bool print_map_solver_table(TableRun& run) {
    std::uint64_t frames = 20000;
    run.add_count("--frames", frames, "Number of frames");
    if (!run.parse()) return true;
    SolverInput input = simulated_input(frames);
    MapSolution& solution = input.start;
    cli::ProgressLine line("solving");
    const std::clock_t start = std::clock();
    solve_map(input.grid, {}, input.reach_mm, input.observations, solution, [&](double share) {
        line.update(std::lround(1000 * share), 1000);
        if (cli::interrupted()) throw Error("interrupted");
    });
    const double time_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const double memory_mb = static_cast<double>(usage.ru_maxrss) / 1024;
    fmt::print(
        "| frames | measured dots | solving, s | per measured dot, µs | iterations | memory, MB | "
        "error of an offset, µm |\n|--:|--:|--:|--:|--:|--:|--:|\n"
        "| {} | {} | {:.0f} | {:.2f} | {} | {:.0f} | {:.3f} |\n",
        frames, input.observations.size(), time_s,
        1e6 * time_s / static_cast<double>(input.observations.size()), solution.iterations,
        memory_mb, offset_error_um(input, solution));
    constexpr double kMaxTime_s = 2 * 300;
    constexpr double kMaxMemory_mb = 2048;
    return time_s <= kMaxTime_s && memory_mb <= kMaxMemory_mb;
}

}  // namespace dotpose::tables
