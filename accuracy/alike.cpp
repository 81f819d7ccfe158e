// Measures the accuracy of frames in which all dots have the same position relative to the pixels:
// spacings of whole pixels, no printing errors, and angles of 0, 45 and 90 degrees. They are
// compared with frames at 7 degrees, in which the biases of single dots average out. Prints a table
// of docs/accuracy.md in Markdown.
//
//   dotpose_alike [--frames N] [--seed S] [--threads N] [--spacings P,...] [--dots D,...]
//                 [--blurs B,...]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "../tests/alike_frames.hpp"
#include "dotpose/tools/score.hpp"
#include "evaluate_all.hpp"

namespace {

using namespace dotpose;

constexpr double kApart_deg = 7;
constexpr std::array kAlike_deg{0.0, 45.0, 90.0};
/// Limits above which cells are marked: of the error relative to that at 7 degrees, and of the mean
/// of error^2 / variance.
constexpr double kMostOfError = 2;
constexpr std::array kNormalised{0.7, 1.5};

struct Arguments {
    Counting counting;
    std::uint64_t frames = 200;
    std::vector<int> spacings_px{8, 10, 11, 12, 16, 20, 24};
    std::vector<double> dots{0.10, 1.0 / 6, 0.25, 0.35};
    std::vector<double> blurs_px{0.3, 0.5, 0.7, 1.0, 1.5};
};

/// Locates the frames of a condition.
Score score_of_condition(const test::AlikeDots& condition, const Arguments& arguments) {
    FrameRun run;
    run.frames = static_cast<int>(arguments.frames);
    run.frame_at = [&](int index) {
        const Shot shot = shot_of(condition, arguments.counting.seed, index);
        return KnownFrame{render(shot), truth_of(shot), {}, {}};
    };
    const std::string what = fmt::format("{} px, dots of {:.2f}, blur {}", condition.spacing_px,
                                         condition.dot, condition.blur_px);
    return score_of(evaluate_all(what, std::move(run), arguments.counting).front());
}

double median_px(const Score& score, const test::AlikeDots& condition) {
    return score.position_um.median / 1000 / camera_of(condition).mm_per_px;
}

bool is_within_claims(const Score& score) {
    return std::ranges::all_of(score.normalised, [](double value) {
        return value >= kNormalised[0] && value <= kNormalised[1];
    });
}

/// Prints a row and returns the number of wrong fixes.
int print_row(test::AlikeDots condition, const Arguments& arguments) {
    condition.angle_deg = kApart_deg;
    const Score apart = score_of_condition(condition, arguments);
    const double apart_px = median_px(apart, condition);
    int wrong = apart.wrong;
    std::string row = fmt::format("| {} | {:.2f} | {} | {:.4f} |", condition.spacing_px,
                                  condition.dot, condition.blur_px, apart_px);
    for (const double angle_deg : kAlike_deg) {
        condition.angle_deg = angle_deg;
        const Score score = score_of_condition(condition, arguments);
        const double error_px = median_px(score, condition);
        const bool is_met = is_within_claims(score) && error_px <= kMostOfError * apart_px;
        row += fmt::format(" {:.4f}, {:.2f} {:.2f} {:.2f}{} |", error_px, score.normalised[0],
                           score.normalised[1], score.normalised[2], is_met ? "" : " **!**");
        wrong += score.wrong;
    }
    fmt::print("{}\n", row);
    std::fflush(stdout);
    return wrong;
}

int run(const Arguments& arguments) {
    fmt::print(
        "| spacing, px | dots, spacings | blur, px | 7 degrees: median error, px "
        "| 0 degrees: the same, and error^2 / variance of x, y, theta | 45 degrees "
        "| 90 degrees |\n|--:|--:|--:|--:|---|---|---|\n");
    int wrong = 0;
    for (const int spacing_px : arguments.spacings_px) {
        for (const double dot : arguments.dots) {
            for (const double blur_px : arguments.blurs_px)
                wrong += print_row({spacing_px, dot, blur_px}, arguments);
        }
    }
    return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    cli::Command app("How exact is a frame whose dots fall on the pixels alike?", "dotpose_alike");
    add_count(app, "--frames", arguments.frames, "How many for each condition");
    app.add_option("--spacings", arguments.spacings_px, "px; 16 and more at 640 x 480")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--dots", arguments.dots, "Diameters, spacings")->delimiter(',');
    app.add_option("--blurs", arguments.blurs_px, "Deviations, px")
        ->delimiter(',')
        ->capture_default_str();
    arguments.counting.add_to(app);
    return run_program(app, argc, argv, [&] { return run(arguments); });
}
