// Measures whether the covariance of a fix is right where the sheet is not one plane: halves of a
// sheet that are displaced against each other, and wrinkled paper. Prints the table of
// docs/integrity.md in Markdown.
//
//   dotpose_slips [--frames N] [--seed S] [--threads N]
//
// There are N frames for each condition. The exit status is 1 if any fix is wrong.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "../tests/slipped_frames.hpp"
#include "dotpose/tools/score.hpp"
#include "evaluate_all.hpp"

namespace {

using namespace dotpose;

/// Fixes whose errors are above this number of their standard deviations are counted.
constexpr double kMostSigmas = 4;

struct Arguments {
    Counting counting;
    std::uint64_t frames = 1000;
};

struct Condition {
    std::string what;
    std::function<void(Shot&)> spoil;
    Preset preset = Preset::nominal;
    bool is_large = false;  ///< 640 x 480 instead of 188 x 120
    Effort effort = Effort::twice;
};

KnownFrame frame_of(const Condition& condition, std::uint64_t seed, int index) {
    Setup setup;
    setup.preset = condition.preset;
    setup.seed = seed;
    if (condition.is_large) {
        setup.camera.width_px = 640;
        setup.camera.height_px = 480;
    }
    Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
    condition.spoil(shot);
    return {render(shot), truth_of(shot), {}, {}};
}

/// Returns the largest error of x, y and theta in units of their standard deviations.
double sigmas_off(const Outcome& outcome) {
    const Deviation off = deviation_of(outcome.fix, outcome.truth);
    const double errors[] = {off.x_grid, off.y_grid, off.theta_rad};
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto variance = static_cast<double>(outcome.fix.covariance[i][i]);
        most = std::max(most, std::abs(errors[i]) / std::sqrt(variance));
    }
    return most;
}

double share(std::span<const Outcome> outcomes, const std::function<bool(const Outcome&)>& holds) {
    return outcomes.empty() ? 0
                            : 100.0 * static_cast<double>(std::ranges::count_if(outcomes, holds)) /
                                  static_cast<double>(outcomes.size());
}

/// Prints the row of one condition and returns the number of wrong fixes.
int print_row(const Condition& condition, const Arguments& arguments) {
    FrameRun run;
    run.frames = static_cast<int>(arguments.frames);
    run.frame_at = [&](int index) { return frame_of(condition, arguments.counting.seed, index); };
    run.options.front().effort = condition.effort;
    const std::string view = condition.is_large ? "640 x 480" : "188 x 120";
    std::vector<Outcome> fixes =
        evaluate_all(condition.what + ", " + view, std::move(run), arguments.counting).front();
    const Score score = score_of(fixes);
    std::erase_if(fixes, [](const Outcome& outcome) { return !outcome.is_fix(); });
    const double within =
        share(fixes, [](const Outcome& outcome) { return sigmas_off(outcome) <= kMostSigmas; });
    const auto share_that_is = [&](Surface surface) {
        return share(fixes, [=](const Outcome& outcome) { return outcome.fix.surface == surface; });
    };
    std::vector<double> sigmas_um;
    for (const Outcome& fix : fixes) {
        sigmas_um.push_back(1000 * fix.truth.spacing_mm *
                            std::sqrt(static_cast<double>(fix.fix.covariance[0][0])));
    }
    fmt::print(
        "| {} | {} | {} | {:.1f} | {:.1f} / {:.1f} | {:.2f} | {:.2f} / {:.2f} / {:.1f} | {:.2f} / "
        "{:.2f} | {:.3f} / {:.2f} | {} |\n",
        condition.what, view, score.frames,
        100.0 * static_cast<double>(fixes.size()) / std::max(score.frames, 1),
        share_that_is(Surface::divided), share_that_is(Surface::uneven), within,
        score.position_um.median, score.position_um.p95, score.position_um.max,
        quantiles_of(sigmas_um).median, quantiles_of(sigmas_um).p95, score.angle_deg.median,
        score.angle_deg.max, score.wrong);
    std::fflush(stdout);
    return score.wrong;
}

std::vector<Condition> all_conditions() {
    const auto slip = [](Shot& shot) { test::apply(test::draw_slip(shot), shot); };
    std::vector<Condition> conditions;
    for (const bool is_large : {false, true}) {
        conditions.push_back({"whole", [](Shot&) {}, Preset::nominal, is_large});
        conditions.push_back({"slipped", slip, Preset::nominal, is_large});
        conditions.push_back(
            {"slipped, first attempt alone", slip, Preset::nominal, is_large, Effort::once});
        conditions.push_back({"slipped, hard", slip, Preset::hard, is_large});
        for (const double amplitude : {0.02, 0.05, 0.10}) {
            conditions.push_back({fmt::format("wrinkled by {:.2f}", amplitude),
                                  [=](Shot& shot) { test::wrinkle(amplitude, shot); },
                                  Preset::nominal, is_large});
        }
    }
    return conditions;
}

int run(const Arguments& arguments) {
    fmt::print(
        "| sheet | view | frames | located, % | divided / uneven, % "
        "| within 4 sigma, % | error, µm: median / 95 % / max | sigma, µm: median / 95 % | angle, "
        "degrees: median / max "
        "| wrong |\n|---|---|--:|--:|---|--:|---|---|---|--:|\n");
    int wrong = 0;
    for (const Condition& condition : all_conditions())
        wrong += print_row(condition, arguments);
    return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    cli::Command app(
        "Does a fix tell how exact it is where the sheet is not one plane? Status 1 if any is "
        "wrong.",
        "dotpose_slips");
    add_count(app, "--frames", arguments.frames, "How many of each condition");
    arguments.counting.add_to(app);
    return run_program(app, argc, argv, [&] { return run(arguments); });
}
