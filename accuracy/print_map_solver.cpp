// Measures the CPU time and memory that the print map solver (docs/print-map.md) needs for an A4
// page and frames of 640 x 480 px. The dots are simulated directly, because rendering all frames
// would take hours.
//
//   dotpose_tables print_map_solver [--frames N]
//
// The CPU time is the sum over all threads, so other programs on the machine hardly affect it. The
// exit status is 1 if the solver needs more than 10 minutes of CPU time (5 minutes on each of two
// cores) or more than 2 GB of memory.
#include <cmath>
#include <cstddef>
#include <ctime>

#include <fmt/core.h>
#include <sys/resource.h>

#include "../tests/map_input.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

using calibrate::MapSolution;

/// Returns the rms error of the offsets per axis, in µm, after subtraction of the mean shift, turn
/// and scale.
double offset_error_um(const test::SolverInput& input, const MapSolution& solution) {
    const auto errors = test::offset_errors_mm(input, solution);
    double squares = 0;
    double count = 0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        if (solution.views[i] == 0) continue;
        squares += errors[i].squaredNorm();
        count += 2;
    }
    return 1000 * std::sqrt(squares / count);
}

}  // namespace

bool print_map_solver_table(TableRun& run) {
    std::uint64_t frames = 20000;
    run.add_count("--frames", frames, "Number of frames");
    if (!run.parse()) return true;
    const test::MappedPrint print(
        {.side_mm = 210, .height_mm = 297, .width_px = 640, .height_px = 480});
    test::SolverInput input = test::simulated_input(print, frames, 5);
    MapSolution& solution = input.start;
    cli::ProgressLine line("solving");
    const std::clock_t start = std::clock();
    solve_map(input.grid, {}, input.reach_mm, input.observations, solution, [&](double fraction) {
        line.update(std::lround(1000 * fraction), 1000);
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
