// Measures the accuracy for frames in which all dots have the same sub-pixel phase. In these
// frames, the spacing is a whole number of pixels, there are no printing errors, and the angle is
// 0, 45 or 90 degrees. The reference is the accuracy at 7 degrees, where the biases of the dots
// average out. Prints a table for docs/accuracy.md in Markdown.
//
//   dotpose_tables alike [--frames N] [--seed S] [--threads N] [--spacings P,...] [--dots D,...]
//                        [--blurs B,...]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "../tests/alike_frames.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

constexpr double kReference_deg = 7;
constexpr std::array kAngles_deg{0.0, 45.0, 90.0};
/// Limits beyond which the table marks a value with "!": the maximum ratio of the error to the
/// error at 7 degrees, and the range for the mean of error^2 / variance.
constexpr double kMaxErrorRatio = 2;
constexpr std::array kNormalisedRange{0.7, 1.5};

struct AlikeOptions {
    std::uint64_t frames = 200;
    std::vector<int> spacings_px{8, 10, 11, 12, 16, 20, 24};
    std::vector<double> dots{0.10, 1.0 / 6, 0.25, 0.35};
    std::vector<double> blurs_px{0.3, 0.5, 0.7, 1.0, 1.5};
};

Score score_of_condition(const test::AlikeDots& condition, std::uint64_t frames,
                         const TableRun& run) {
    FrameRun frame_run;
    frame_run.frames = static_cast<int>(frames);
    frame_run.frame_at = [&](int index) {
        return known_frame(shot_of(condition, run.seed, index));
    };
    const std::string what = fmt::format("{} px, dots of {:.2f}, blur {}", condition.spacing_px,
                                         condition.dot, condition.blur_px);
    return score_of(run.evaluate(what, std::move(frame_run)).front());
}

double median_px(const Score& score, const test::AlikeDots& condition) {
    return score.position_um.median / 1000 / camera_of(condition).mm_per_px;
}

bool agrees_with_covariance(const Score& score) {
    return std::ranges::all_of(score.normalised, [](double value) {
        return value >= kNormalisedRange[0] && value <= kNormalisedRange[1];
    });
}

/// Prints one row of the table and returns the number of wrong fixes.
int print_row(test::AlikeDots condition, std::uint64_t frames, const TableRun& run) {
    condition.angle_deg = kReference_deg;
    const Score reference = score_of_condition(condition, frames, run);
    const double reference_px = median_px(reference, condition);
    int wrong = reference.wrong;
    std::string row = fmt::format("| {} | {:.2f} | {} | {:.4f} |", condition.spacing_px,
                                  condition.dot, condition.blur_px, reference_px);
    for (const double angle_deg : kAngles_deg) {
        condition.angle_deg = angle_deg;
        const Score score = score_of_condition(condition, frames, run);
        const double error_px = median_px(score, condition);
        const bool is_met =
            agrees_with_covariance(score) && error_px <= kMaxErrorRatio * reference_px;
        row += fmt::format(" {:.4f}, {:.2f} {:.2f} {:.2f}{} |", error_px, score.normalised[0],
                           score.normalised[1], score.normalised[2], is_met ? "" : " **!**");
        wrong += score.wrong;
    }
    fmt::print("{}\n", row);
    std::fflush(stdout);
    return wrong;
}

}  // namespace

bool alike_table(TableRun& run) {
    AlikeOptions options;
    run.add_count("--frames", options.frames, "Number of frames for each condition");
    run.command
        .add_option("--spacings", options.spacings_px,
                    "Spacings of the grid, px; from 16 px on, images have 640 x 480 px")
        ->delimiter(',')
        ->capture_default_str();
    run.command.add_option("--dots", options.dots, "Diameters of the dots, in spacings")
        ->delimiter(',');
    run.command.add_option("--blurs", options.blurs_px, "Standard deviations of the blur, px")
        ->delimiter(',')
        ->capture_default_str();
    run.add_seed();
    run.add_threads();
    if (!run.parse()) return true;

    fmt::print(
        "| spacing, px | dots, spacings | blur, px | 7 degrees: median error, px "
        "| 0 degrees: the same, and error^2 / variance of x, y, theta | 45 degrees "
        "| 90 degrees |\n|--:|--:|--:|--:|---|---|---|\n");
    int wrong = 0;
    for (const int spacing_px : options.spacings_px) {
        for (const double dot : options.dots) {
            for (const double blur_px : options.blurs_px)
                wrong += print_row({spacing_px, dot, blur_px}, options.frames, run);
        }
    }
    return wrong == 0;
}

}  // namespace dotpose::tables
