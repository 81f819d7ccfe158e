// Regenerates all numbers and figures in docs/speed.md. `make bench` runs this program.
//
//   dotpose_bench [--quick] [--update docs/speed.md] [FOLDER]
//   dotpose_bench --benchmark_filter=stage [--benchmark_...]
//
// Writes tables.md, pixels.svg and dots.svg to FOLDER (default: bench-out). --update also replaces
// the generated blocks in the document and its figures. --quick does a short run to test the
// program. The numbers from such a run are inaccurate. If Google Benchmark options are given, runs
// and prints only the selected benchmarks.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include <dotpose/files/error.hpp>

#include "../accuracy/document.hpp"
#include "benchmarks.hpp"
#include "draw/svg.hpp"

namespace dotpose::bench {
namespace {

namespace fs = std::filesystem;

struct Arguments {
    fs::path out = "bench-out";
    fs::path document;
    bool is_quick = false;
    bool is_partial = false;
    std::vector<std::string> library = {"dotpose_bench"};  ///< command line of Google Benchmark
};

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    // Interleaves the repetitions of all benchmarks. Temporary load on the machine then slows some
    // repetitions of several benchmarks, rather than all repetitions of one benchmark.
    for (const char* option : {"--benchmark_enable_random_interleaving=true",
                               "--benchmark_repetitions=9", "--benchmark_min_time=0.05"})
        arguments.library.emplace_back(option);
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i];
        if (argument == "--quick") {
            arguments.is_quick = true;
            arguments.library.emplace_back("--benchmark_repetitions=2");
            arguments.library.emplace_back("--benchmark_min_time=0.01");
        } else if (argument == "--update" && i + 1 < argc) {
            arguments.document = argv[++i];
        } else if (argument.starts_with("--benchmark_")) {
            arguments.is_partial = true;
            arguments.library.emplace_back(argument);
        } else if (argument.starts_with('-')) {
            throw BadArgument(
                "usage: dotpose_bench [--quick] [--update DOCUMENT] [FOLDER]\n"
                "       dotpose_bench --benchmark_filter=REGEX [--benchmark_...]");
        } else {
            arguments.out = argument;
        }
    }
    if (arguments.is_partial && !arguments.document.empty()) {
        throw BadArgument("--update needs all benchmarks, so no --benchmark_... beside it");
    }
    return arguments;
}

void run_benchmarks(std::vector<std::string> options, Results& results) {
    std::vector<char*> argv;
    for (std::string& option : options)
        argv.push_back(option.data());
    int argc = static_cast<int>(argv.size());
    benchmark::Initialize(&argc, argv.data());
    if (benchmark::ReportUnrecognizedArguments(argc, argv.data())) {
        throw BadArgument("not an option of Google Benchmark");
    }
    add_frame_benchmarks();
    add_stage_benchmarks();
    add_code_benchmarks();
    benchmark::RunSpecifiedBenchmarks(&results);
    if (results.has_failed()) throw Error("a benchmark found a wrong answer");
}

struct Aim {
    const char* words;
    double at_most;
    double measured;
    int decimals;
};

const FrameTimes& of_width(const std::vector<FrameTimes>& sizes, int width_px) {
    return *std::ranges::find(sizes, width_px,
                              [](const FrameTimes& t) { return t.camera.width_px; });
}

/// Returns the worst values over all tilts: the lowest percentage of frames that the first attempt
/// locates, and the highest ratio of the median time to the median time without tilt.
std::pair<double, double> worst_tilt(const std::vector<TiltTimes>& tilts) {
    double fraction = 100;
    double ratio = 1;
    double straight_us = 1;
    for (const TiltTimes& t : tilts) {
        if (t.tilt_deg == 0) straight_us = t.median_us;
        fraction = std::min(fraction, 100.0 * t.by_first_attempt / t.frames);
        ratio = std::max(ratio, t.median_us / straight_us);
    }
    return {fraction, ratio};
}

/// Returns a table that compares measured values with their targets.
std::string aims_table(const std::vector<FrameTimes>& sizes, const Varied& varied,
                       const std::vector<TiltTimes>& tilts, const std::vector<SmallTimes>& small,
                       const HardTimes& hard) {
    const double locate_us = varied.of(Way::twice).median_us;
    const FrameTimes& vga = of_width(sizes, 640);
    const auto [fraction, ratio] = worst_tilt(tilts);
    const std::vector<Aim> aims = {
        {"188 x 120, median, µs", 15, locate_us, 1},
        {"188 x 120, median / libapriltag with decimate 2", 1.0 / 32,
         locate_us / varied.of(Way::apriltag_2).median_us, 4},
        {"188 x 120, median / one pass", 30, locate_us / varied.of(Way::floor).median_us, 0},
        {"188 x 120, tracked, µs", 8, varied.of(Way::tracked).median_us, 1},
        {"188 x 120, without AVX2 / with it", 1.8,
         varied.of(Way::narrow).median_us / varied.of(Way::once).median_us, 2},
        {"188 x 120, 99 % / median, `--effort once`", 1.6, varied.of(Way::once).p99_over_median(),
         2},
        {"640 x 480 with 2,500 dots, µs", 100, vga.locate_us, 0},
        {"640 x 480 with 2,500 dots / one pass", 16, vga.locate_us / vga.floor_us, 0},
        {"640 x 480 with 2,500 dots, tracked, µs", 60, vga.tracked_us, 0},
        {"1280 x 800, µs", 300, of_width(sizes, 1280).locate_us, 0},
        {"12 megapixels at 6 px per spacing, µs", 2000, of_width(sizes, 4000).locate_us, 0},
        {"tilted by up to 20 degrees, not located by the first attempt, %", 2, 100 - fraction, 1},
        {"tilted by up to 20 degrees, median / that at 0 degrees", 2, ratio, 2},
        {"frames of 64 x 64 to 96 x 96, longest without a second attempt / median of 188 x 120", 4,
         longest_first_ratio(small), 1},
        {"hard frames of 188 x 120, 99 %, ms", 5, hard.p99_ms, 2},
        {"hard frames of 188 x 120, longest of 20,000, ms", 15, hard.longest_ms, 1},
    };
    std::string table = "| | at most | measured | |\n|---|--:|--:|---|\n";
    for (const Aim& aim : aims) {
        table += fmt::format("| {} | {:.4g} | {} | {} |\n", aim.words, aim.at_most,
                             fmt::format("{:.{}f}", aim.measured, aim.decimals),
                             aim.measured <= aim.at_most ? "met" : "**missed**");
    }
    return table;
}

void run(const Arguments& arguments) {
    Results results;
    if (arguments.is_partial) return run_benchmarks(arguments.library, results);
    // Reports an unreadable document before the measurement starts, because the measurement takes
    // minutes.
    if (!arguments.document.empty()) read_document(arguments.document);
    fs::create_directories(arguments.out);

    const std::string load_before = load_average();
    fmt::print(stderr, "benchmarks take turns for some minutes, results come at the end\n");
    run_benchmarks(arguments.library, results);
    const Varied varied =
        arguments.is_quick ? time_varied_frames(200, 2) : time_varied_frames(2000, 10);
    const std::vector<TiltTimes> tilts = time_tilted_frames(arguments.is_quick);
    const std::vector<SmallTimes> small = time_small_frames(arguments.is_quick);
    const HardTimes hard = time_hard_frames(arguments.is_quick ? 500 : 20'000);
    const std::string load =
        fmt::format("- load average before: {}; after: {}\n", load_before, load_average());

    const std::vector<FrameTimes> sizes = times_by_size(results);
    const std::vector<FrameTimes> by_dots = times_by_dots(results);
    const Blocks blocks = {
        {"machine", machine_list() + load}, {"aims", aims_table(sizes, varied, tilts, small, hard)},
        {"sizes", size_table(sizes)},       {"dots", dots_table(by_dots)},
        {"varied", varied_table(varied)},   {"tilts", tilt_table(tilts)},
        {"small", small_table(small)},      {"hard", hard_table(hard)},
        {"stages", stage_table(results)},   {"code", code_table(results)}};
    draw::write_file(arguments.out / "pixels.svg",
                     [&](std::ostream& out) { draw_pixels(out, sizes); });
    draw::write_file(arguments.out / "dots.svg",
                     [&](std::ostream& out) { draw_dots(out, by_dots); });
    for (const Block& block : blocks)
        fmt::print("\n{}", block.text);
    write_tables(arguments.out, blocks, arguments.document);
}

}  // namespace
}  // namespace dotpose::bench

int main(int argc, char** argv) {
    try {
        dotpose::bench::run(dotpose::bench::parse(argc, argv));
        return 0;
    } catch (const dotpose::BadArgument& error) {
        fmt::print(stderr, "dotpose_bench: {}\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "dotpose_bench: {}\n", error.what());
        return 1;
    }
}
