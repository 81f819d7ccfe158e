// Measures how much a print map improves the accuracy of positions (docs/print-map.md). The map is
// tested on frames that were not used to make it.
//
//   dotpose_tables print_map [--frames N] [--tests N] [--side MM] [--update DOCUMENT]
//
// The exit status is 1 if the repeatability exceeds 0.12 µm, or if the absolute error exceeds a
// fifth of the absolute error without the map.
#include <array>
#include <chrono>
#include <string>

#include <fmt/core.h>

#include "../tests/mapped_print.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

constexpr double kMaxRepeatability_um = 0.12;
constexpr double kMaxAbsolute = 0.2;  ///< limit relative to the absolute error without the map

struct PrintKind {
    const char* name;
    double jitter_mm;
    double wave_mm;
    double wavelength_mm;
};
constexpr std::array kPrints = {PrintKind{"jitter of 10 µm", 0.010, 0, 50},
                                PrintKind{"feed wave of 40 µm, every 50 mm", 0, 0.040, 50},
                                PrintKind{"both", 0.010, 0.040, 50},
                                PrintKind{"both, every 25 mm", 0.010, 0.040, 25}};

struct FrameNumbers {
    std::uint64_t frames = 500;
    std::uint64_t tests = 300;
    double side_mm = 60;
};

PrintMapResult make_map(const test::MappedPrint& print, const FrameNumbers& numbers,
                        const char* name) {
    cli::ProgressLine line(fmt::format("mapping {}", name));
    return test::map_of(print, static_cast<int>(numbers.frames), 100, {}, [&](int i) {
        line.update(i, static_cast<std::int64_t>(numbers.frames));
        if (cli::interrupted()) throw Error("interrupted");
    });
}

std::string row_text(const PrintKind& kind, const PrintMapResult& map, const test::MapTest& test) {
    const MappedPage& page = map.pages.front();
    const double wave = kind.wave_mm > 0 ? 1 : 0;
    const double sigma = test.with.sigma_um();
    const double error = test.with.absolute_um();
    return fmt::format(
        "| {} | {:.1f} | {:.2f} | {:.1f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.2f} |\n",
        kind.name, 1000 * page.jitter_mm, 1000 * page.noise_mm, 1000 * page.slow_mm,
        test.without.repeatability_um(wave), test.with.repeatability_um(0),
        test.without.absolute_um(), error, error * error / (sigma * sigma));
}

}  // namespace

bool print_map_table(TableRun& run) {
    FrameNumbers numbers;
    run.add_count("--frames", numbers.frames, "Number of frames of each map");
    run.add_count("--tests", numbers.tests, "Number of other frames that test each map");
    run.command.add_option("--side", numbers.side_mm, "Side of the page, mm")
        ->check(cli::Range(30.0, 300.0))
        ->capture_default_str();
    run.add_update();
    if (!run.parse()) return true;
    std::string text =
        "| print | jitter found, µm | noise of a dot, µm | slow distortion found, µm | "
        "repeatability, µm: without | with map | absolute error, µm: without | with map | error² / "
        "variance with map |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    bool is_right = true;
    for (const PrintKind& kind : kPrints) {
        test::MappedPrintOptions options;
        options.side_mm = numbers.side_mm;
        options.jitter_mm = kind.jitter_mm;
        options.wave_mm = kind.wave_mm;
        options.wavelength_mm = kind.wavelength_mm;
        const test::MappedPrint print(options);
        const PrintMapResult map = make_map(print, numbers, kind.name);
        const test::MapTest test = test::test_map(print, map.map, static_cast<int>(numbers.tests));
        text += row_text(kind, map, test);
        is_right &= test.with.repeatability_um(0) <= kMaxRepeatability_um &&
                    test.with.absolute_um() <= kMaxAbsolute * test.without.absolute_um();
    }
    run.print_block("print-map", text);
    run.update_document();
    return is_right;
}

}  // namespace dotpose::tables
