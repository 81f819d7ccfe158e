#include "uneven_table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "dotpose/tools/score.hpp"
#include "evaluate_all.hpp"

namespace dotpose {
namespace {

/// Fixes whose errors are above this number of their standard deviations are counted.
constexpr double kMostSigmas = 4;

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

}  // namespace

void print_uneven_head() {
    fmt::print(
        "| sheet | view | frames | located, % | divided / uneven, % "
        "| within 4 sigma, % | error, µm: median / 95 % / max | sigma, µm: median / 95 % | angle, "
        "degrees: median / max "
        "| wrong |\n|---|---|--:|--:|---|--:|---|---|---|--:|\n");
}

int print_uneven_row(const SheetFrames& sheet, int frames, const Counting& counting) {
    FrameRun run;
    run.frames = frames;
    run.frame_at = sheet.frame_at;
    run.options.front().effort = sheet.effort;
    std::vector<Outcome> fixes =
        evaluate_all(sheet.what + ", " + sheet.view, std::move(run), counting).front();
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
        sheet.what, sheet.view, score.frames,
        100.0 * static_cast<double>(fixes.size()) / std::max(score.frames, 1),
        share_that_is(Surface::divided), share_that_is(Surface::uneven), within,
        score.position_um.median, score.position_um.p95, score.position_um.max,
        quantiles_of(sigmas_um).median, quantiles_of(sigmas_um).p95, score.angle_deg.median,
        score.angle_deg.max, score.wrong);
    std::fflush(stdout);
    return score.wrong;
}

}  // namespace dotpose
