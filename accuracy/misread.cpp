// Measures how many small views are located if the rate of misread bits is unknown, declared by the
// caller, or measured by the locator. Also measures how many fixes are wrong, if the declaration is
// true and if it is false. Prints tables in Markdown.
//
//   dotpose_tables misread [--frames N] [--flipped N] [--seed S] [--threads N]
//
// The frames are divided into series of 500 frames. One locator locates each series, so a measured
// rate is unknown at the start of a series.
//
// The exit status is 1 if a fix of a nominal frame is wrong, if more fixes of frames with flipped
// bits are wrong than p_wrong predicts although no false rate is declared, if the measured number
// of bits per error exceeds the true number, or if the run is interrupted.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/core.h>

#include "../tests/altered_pattern.hpp"
#include "dotpose/tools/simulate.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

struct View {
    double spacing_px;
    int side_px;
};
constexpr std::array kViews{View{6, 64}, View{7, 64}, View{9, 80}, View{10, 88}, View{11, 96}};

/// Values of `bits_per_error`. 0: the rate is unknown.
constexpr std::array kBitsPerError{0, 100, 300, 1000, 3000, kMeasuredErrorRate};

constexpr std::uint64_t kFramesOfSeries = 500;

struct MisreadTally {
    std::uint64_t located = 0;
    std::uint64_t wrong = 0;
    double predicted = 0;  ///< expected number of wrong fixes: the sum of p_wrong
    std::uint64_t bits = 0;
    std::uint64_t misread = 0;
    double measured = 0;  ///< sum of the bits per error measured at the end of each series

    void operator+=(const MisreadTally& other) {
        located += other.located;
        wrong += other.wrong;
        predicted += other.predicted;
        bits += other.bits;
        misread += other.misread;
        measured += other.measured;
    }
};

Shot draw_view(const View& view, std::uint64_t seed, std::uint64_t index) {
    Setup setup = tables::setup_of(seed, view.side_px, view.side_px);
    setup.camera.mm_per_px = setup.pattern.spacing_mm / view.spacing_px;
    return draw_shot(setup, index);
}

void locate(const GreyImage& image, const Shot& shot, Locator& locator, MisreadTally& tally) {
    Outcome outcome;
    outcome.fix = locator.locate(image.view());
    outcome.truth = truth_of(shot);
    if (!outcome.is_fix()) return;
    ++tally.located;
    tally.wrong += outcome.is_wrong();
    tally.predicted += outcome.fix.p_wrong();
    tally.bits += 2 * static_cast<std::uint64_t>(outcome.fix.dots_used);
    tally.misread += static_cast<std::uint64_t>(outcome.fix.bit_errors);
}

std::uint64_t number_of_series(std::uint64_t frames) {
    return (frames + kFramesOfSeries - 1) / kFramesOfSeries;
}

/// Locates the frames of all series. `draw(i)` returns frame i and its image.
template <typename Draw>
Count<MisreadTally> locate_series(std::uint64_t frames, const IntegrityOptions& integrity,
                                  const TableRun& run, const Draw& draw) {
    return run.count<MisreadTally>(
        "series", number_of_series(frames), [&](std::uint64_t series, MisreadTally& tally) {
            DeviceOptions options;
            options.integrity = integrity;
            Locator locator(thread_memory(), options);
            const std::uint64_t first = series * kFramesOfSeries;
            for (std::uint64_t i = first; i < std::min(first + kFramesOfSeries, frames); ++i) {
                const auto [shot, image] = draw(i);
                locate(image, shot, locator, tally);
            }
            tally.measured += locator.error_rate().bits_per_error();
        });
}

double percent(std::uint64_t part, std::uint64_t all) {
    return 100 * static_cast<double>(part) / static_cast<double>(all);
}

struct DrawnFrame {
    Shot shot;
    GreyImage image;
};

/// Prints the percentage of nominal frames that are located. Returns true if no fix is wrong.
bool print_located(const View& view, std::uint64_t frames, const TableRun& run) {
    fmt::print("| {} | {} x {} |", view.spacing_px, view.side_px, view.side_px);
    MisreadTally all;
    bool is_complete = true;
    for (const int bits_per_error : kBitsPerError) {
        const auto count = locate_series(frames, {.bits_per_error = bits_per_error}, run,
                                         [&](std::uint64_t i) -> DrawnFrame {
                                             const Shot shot = draw_view(view, run.seed, i);
                                             return {shot, render(shot)};
                                         });
        fmt::print(" {:.1f} |", percent(count.tally.located, frames));
        std::fflush(stdout);
        all += count.tally;
        is_complete &= count.is_complete();
    }
    fmt::print(" {} | {} of {} |\n", all.wrong, all.misread, all.bits);
    return all.wrong == 0 && is_complete;
}

/// Locates frames whose bits are flipped at a rate of 1 / `true_bits`, with a limit at which some
/// fixes are wrong. Returns true if at most as many fixes are wrong as p_wrong predicts, or if a
/// false rate is declared.
bool print_flipped(int true_bits, int bits_per_error, std::uint64_t frames, const TableRun& run) {
    constexpr int kLooseLimit_log2 = -4;
    MisreadTally all;
    bool is_complete = true;
    for (const View& view : kViews) {
        const auto count = locate_series(
            frames, {.max_p_wrong_log2 = kLooseLimit_log2, .bits_per_error = bits_per_error}, run,
            [&](std::uint64_t i) -> DrawnFrame {
                const Shot shot = draw_view(view, run.seed, i);
                const Pattern pattern = shot.page.pattern;
                return {shot, test::render_dots(shot, [&](Cell cell) {
                            return test::displacement_of(
                                test::flipped_symbol(pattern, 1.0 / true_bits, shot.seed, cell));
                        })};
            });
        all += count.tally;
        is_complete &= count.is_complete();
    }
    const auto series = static_cast<double>(number_of_series(frames) * kViews.size());
    fmt::print("| {} | {} | {} | {} | {} | {:.1f} | {:.0f} |\n", true_bits, bits_per_error,
               frames * kViews.size(), all.located, all.wrong, all.predicted,
               all.measured / series);
    std::fflush(stdout);
    const bool is_declared = bits_per_error != kMeasuredErrorRate;
    if (!is_declared && all.measured / series > true_bits) return false;
    const bool is_true = bits_per_error <= true_bits;
    return is_complete && (!is_true || static_cast<double>(all.wrong) <= all.predicted);
}

}  // namespace

bool misread_table(TableRun& run) {
    std::uint64_t frames = 1000;
    std::uint64_t flipped = 2000;
    run.add_count("--frames", frames, "Number of nominal frames of each size");
    run.add_count("--flipped", flipped, "Number of frames with flipped bits of each size");
    run.add_seed();
    run.add_threads();
    if (!run.parse()) return true;
    bool is_right = true;
    if (frames > 0) {
        fmt::print("| spacing, px | view, px |");
        for (const int bits_per_error : kBitsPerError)
            fmt::print(" {} |", bits_per_error);
        fmt::print(" wrong | bits misread |\n|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
        for (const View& view : kViews)
            is_right &= print_located(view, frames, run);
    }
    if (flipped > 0) {
        fmt::print(
            "\n| bits per flipped bit | bits_per_error | frames | located | wrong | predicted | "
            "measured |\n|--:|--:|--:|--:|--:|--:|--:|\n");
        for (const int true_bits : {30, 100, 1000}) {
            for (const int bits_per_error : {0, 30, 100, 1000, kMeasuredErrorRate})
                is_right &= print_flipped(true_bits, bits_per_error, flipped, run);
        }
    }
    return is_right;
}

}  // namespace dotpose::tables
