// Measures how many small views are located if the caller declares the rate of misread bits, and
// how many fixes are wrong if the declaration is true and if it is false. Prints tables in
// Markdown.
//
//   dotpose_tables misread [--frames N] [--flipped N] [--seed S] [--threads N]
//
// The exit status is 1 if a fix of a nominal frame is wrong, if more fixes of frames with flipped
// bits are wrong than p_wrong predicts although the declaration is true, or if the run is
// interrupted.
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

/// Declared numbers of bits per misread bit. 0: nothing is declared.
constexpr std::array kDeclared{0, 100, 300, 1000, 3000};

struct MisreadTally {
    std::uint64_t located = 0;
    std::uint64_t wrong = 0;
    double predicted = 0;  ///< expected number of wrong fixes: the sum of p_wrong
    std::uint64_t bits = 0;
    std::uint64_t misread = 0;

    void operator+=(const MisreadTally& other) {
        located += other.located;
        wrong += other.wrong;
        predicted += other.predicted;
        bits += other.bits;
        misread += other.misread;
    }
};

Shot draw_view(const View& view, std::uint64_t seed, std::uint64_t index) {
    Setup setup = tables::setup_of(seed, view.side_px, view.side_px);
    setup.camera.mm_per_px = setup.pattern.spacing_mm / view.spacing_px;
    return draw_shot(setup, index);
}

void locate(const GreyImage& image, const Shot& shot, const IntegrityOptions& integrity,
            MisreadTally& tally) {
    DeviceOptions options;
    options.integrity = integrity;
    Outcome outcome;
    outcome.fix = Locator(thread_memory(), options).locate(image.view());
    outcome.truth = truth_of(shot);
    if (!outcome.is_fix()) return;
    ++tally.located;
    tally.wrong += outcome.is_wrong();
    tally.predicted += outcome.fix.p_wrong();
    tally.bits += 2 * static_cast<std::uint64_t>(outcome.fix.dots_used);
    tally.misread += static_cast<std::uint64_t>(outcome.fix.bit_errors);
}

double percent(std::uint64_t part, std::uint64_t all) {
    return 100 * static_cast<double>(part) / static_cast<double>(all);
}

/// Prints the percentage of nominal frames that are located. Returns true if no fix is wrong.
bool print_located(const View& view, std::uint64_t frames, const TableRun& run) {
    fmt::print("| {} | {} x {} |", view.spacing_px, view.side_px, view.side_px);
    MisreadTally all;
    bool is_complete = true;
    for (const int bits_per_error : kDeclared) {
        const auto count =
            run.count<MisreadTally>("frames", frames, [&](std::uint64_t i, MisreadTally& t) {
                const Shot shot = draw_view(view, run.seed, i);
                locate(render(shot), shot, {.bits_per_error = bits_per_error}, t);
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
/// fixes are wrong. Returns true if at most as many fixes are wrong as p_wrong predicts, or if the
/// declaration is false.
bool print_flipped(int true_bits, int declared, std::uint64_t frames, const TableRun& run) {
    constexpr int kLooseLimit_log2 = -4;
    MisreadTally all;
    bool is_complete = true;
    for (const View& view : kViews) {
        const auto count =
            run.count<MisreadTally>("frames", frames, [&](std::uint64_t i, MisreadTally& t) {
                const Shot shot = draw_view(view, run.seed, i);
                const Pattern pattern = shot.page.pattern;
                const GreyImage image = test::render_dots(shot, [&](Cell cell) {
                    return test::displacement_of(
                        test::flipped_symbol(pattern, 1.0 / true_bits, shot.seed, cell));
                });
                locate(image, shot,
                       {.max_p_wrong_log2 = kLooseLimit_log2, .bits_per_error = declared}, t);
            });
        all += count.tally;
        is_complete &= count.is_complete();
    }
    fmt::print("| {} | {} | {} | {} | {} | {:.1f} |\n", true_bits, declared, frames * kViews.size(),
               all.located, all.wrong, all.predicted);
    std::fflush(stdout);
    const bool is_true = declared <= true_bits;
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
        for (const int declared : kDeclared)
            fmt::print(" {} |", declared);
        fmt::print(" wrong | bits misread |\n|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
        for (const View& view : kViews)
            is_right &= print_located(view, frames, run);
    }
    if (flipped > 0) {
        fmt::print(
            "\n| bits per flipped bit | declared | frames | located | wrong | predicted |\n"
            "|--:|--:|--:|--:|--:|--:|\n");
        for (const int true_bits : {30, 100, 1000}) {
            for (const int declared : {0, 30, 100, 1000})
                is_right &= print_flipped(true_bits, declared, flipped, run);
        }
    }
    return is_right;
}

}  // namespace dotpose::tables
