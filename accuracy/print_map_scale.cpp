// Measures the CPU time and memory needed to make a print map of an A4 page from many frames of
// 640 x 480 px (docs/print-map.md).
//
//   dotpose_tables print_map_scale [--frames N] [--threads N]
//
// The CPU time is the sum over all threads, so other programs on the machine hardly affect it. The
// exit status is 1 unless the map corrects all 50 test frames.
#include <algorithm>
#include <ctime>
#include <thread>
#include <vector>

#include <fmt/core.h>
#include <sys/resource.h>

#include "../tests/mapped_print.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

/// Processor time of each stage, in s.
struct StageTimes {
    double rendering = 0;
    double locating = 0;
    double solving = 0;
};

/// Adds the CPU time of `work` to `sum`.
template <typename Work>
void add_time(double& sum, const Work& work) {
    const std::clock_t start = std::clock();
    work();
    sum += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Returns the peak memory of the process, in MB.
double peak_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Renders `count` frames, starting with frame `first`, on all threads.
std::vector<GreyImage> rendered_batch(const test::MappedPrint& print, std::uint64_t first,
                                      std::size_t count, unsigned threads) {
    constexpr std::uint64_t kSeries = 100;
    std::vector<GreyImage> images(count);
    std::vector<std::jthread> workers;
    for (unsigned thread = 0; thread < threads; ++thread) {
        workers.emplace_back([&, thread] {
            for (std::size_t i = thread; i < count; i += threads)
                images[i] = print.frame(print.pose(kSeries, first + i), scramble(first + i));
        });
    }
    workers.clear();
    return images;
}

}  // namespace

bool print_map_scale_table(TableRun& run) {
    std::uint64_t frames = 4000;
    run.add_count("--frames", frames, "Number of frames");
    run.add_threads();
    if (!run.parse()) return true;
    const test::MappedPrint print(
        {.side_mm = 210, .height_mm = 297, .width_px = 640, .height_px = 480});
    PrintMapping mapping({.sheets = {print.entry()}, .camera = {}, .earlier = {}});
    StageTimes times;
    {
        cli::ProgressLine line("rendering and locating");
        constexpr std::uint64_t kBatch = 64;
        for (std::uint64_t first = 0; first < frames; first += kBatch) {
            line.update(static_cast<std::int64_t>(first), static_cast<std::int64_t>(frames));
            if (cli::interrupted()) throw Error("interrupted");
            std::vector<GreyImage> images;
            add_time(times.rendering, [&] {
                images =
                    rendered_batch(print, first, std::min(kBatch, frames - first), run.threads);
            });
            add_time(times.locating, [&] {
                for (const GreyImage& image : images)
                    mapping.add(image.view());
            });
        }
    }
    const double located_mb = peak_mb();
    PrintMapResult result;
    add_time(times.solving, [&] { result = mapping.solve(); });
    const double solved_mb = peak_mb();
    const MappedPage& page = result.pages.front();
    fmt::print(
        "| frames | measured dots | rendering, s | locating, s | solving, s | per measured dot, µs "
        "| "
        "memory before, MB | at the end, MB | jitter found, µm | noise, µm |\n"
        "|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n"
        "| {} | {} | {:.0f} | {:.1f} | {:.1f} | {:.2f} | {:.0f} | {:.0f} | {:.2f} | {:.2f} |\n",
        page.frames, page.observations, times.rendering, times.locating, times.solving,
        1e6 * times.solving / static_cast<double>(page.observations), located_mb, solved_mb,
        1000 * page.jitter_mm, 1000 * page.noise_mm);
    const test::MapTest test = test::test_map(print, result.map, 50);
    fmt::print("{} of 50 other frames corrected, absolute error {:.3f} instead of {:.3f} µm\n",
               test.used, test.with.absolute_um(), test.without.absolute_um());
    return test.used == 50;
}

}  // namespace dotpose::tables
