// Compares the errors of fixes with the reported covariances, for sheets that are not planar.
// Locates N frames for each condition, and prints tables for docs/integrity.md in Markdown.
//
//   dotpose_tables slips [--frames N] [--seed S] [--threads N]
//   dotpose_tables seams [--frames N] [--seed S] [--threads N]
//
// `slips`: sheets whose halves are displaced relative to each other, and wrinkled paper.
// `seams`: two adjacent sheets, drawn by a renderer that is independent of the simulator.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "../tests/seam_frames.hpp"
#include "../tests/slipped_frames.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

struct ImageSize {
    int width_px;
    int height_px;
    std::string text() const { return fmt::format("{} x {}", width_px, height_px); }
};
constexpr std::array kSizes{ImageSize{188, 120}, ImageSize{640, 480}};

/// Frames of one kind of sheet.
struct SheetFrames {
    std::string what;
    ImageSize size;
    FrameSource frame_at;
    Effort effort = Effort::twice;
};

/// Maximum error, in standard deviations, that is still consistent with the covariance of a fix.
constexpr double kMaxSigmas = 4;

/// Returns the maximum of the errors in x, y and theta, each in units of its standard deviation.
double max_error_sigmas(const Outcome& outcome) {
    const Deviation off = deviation_of(outcome.fix, outcome.truth);
    const double errors[] = {off.x_grid, off.y_grid, off.theta_rad};
    double max = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto variance = static_cast<double>(outcome.fix.covariance[i][i]);
        max = std::max(max, std::abs(errors[i]) / std::sqrt(variance));
    }
    return max;
}

double fraction(std::span<const Outcome> outcomes,
                const std::function<bool(const Outcome&)>& holds) {
    return outcomes.empty() ? 0
                            : 100.0 * static_cast<double>(std::ranges::count_if(outcomes, holds)) /
                                  static_cast<double>(outcomes.size());
}

void print_uneven_head() {
    fmt::print(
        "| sheet | view | frames | located, % | divided / uneven, % "
        "| within 4 sigma, % | error, µm: median / 95 % / max | sigma, µm: median / 95 % | angle, "
        "degrees: median / max "
        "| wrong |\n|---|---|--:|--:|---|--:|---|---|---|--:|\n");
}

/// Locates `frames` frames and prints a table row. Returns the number of wrong fixes. Throws Error
/// if interrupted.
int print_uneven_row(const SheetFrames& sheet, std::uint64_t frames, const TableRun& run) {
    FrameRun frame_run;
    frame_run.frames = static_cast<int>(frames);
    frame_run.frame_at = sheet.frame_at;
    frame_run.options.front().effort = sheet.effort;
    std::vector<Outcome> fixes =
        run.evaluate(sheet.what + ", " + sheet.size.text(), std::move(frame_run)).front();
    const Score score = score_of(fixes);
    std::erase_if(fixes, [](const Outcome& outcome) { return !outcome.is_fix(); });
    const double within = fraction(
        fixes, [](const Outcome& outcome) { return max_error_sigmas(outcome) <= kMaxSigmas; });
    const auto fraction_that_is = [&](Surface surface) {
        return fraction(fixes,
                        [=](const Outcome& outcome) { return outcome.fix.surface == surface; });
    };
    std::vector<double> sigmas_um;
    for (const Outcome& fix : fixes) {
        sigmas_um.push_back(1000 * fix.truth.spacing_mm *
                            std::sqrt(static_cast<double>(fix.fix.covariance[0][0])));
    }
    fmt::print(
        "| {} | {} | {} | {:.1f} | {:.1f} / {:.1f} | {:.2f} | {:.2f} / {:.2f} / {:.1f} | {:.2f} / "
        "{:.2f} | {:.3f} / {:.2f} | {} |\n",
        sheet.what, sheet.size.text(), score.frames,
        100.0 * static_cast<double>(fixes.size()) / std::max(score.frames, 1),
        fraction_that_is(Surface::divided), fraction_that_is(Surface::uneven), within,
        score.position_um.median, score.position_um.p95, score.position_um.max,
        quantiles_of(sigmas_um).median, quantiles_of(sigmas_um).p95, score.angle_deg.median,
        score.angle_deg.max, score.wrong);
    std::fflush(stdout);
    return score.wrong;
}

std::vector<SheetFrames> slips(std::uint64_t seed) {
    using Spoil = std::function<void(Shot&)>;
    const Spoil slip = [](Shot& shot) { test::apply(test::draw_slip(shot), shot); };
    std::vector<SheetFrames> all;
    for (const ImageSize size : kSizes) {
        const auto add = [&](const std::string& what, const Spoil& spoil,
                             Preset preset = Preset::nominal, Effort effort = Effort::twice) {
            Setup setup = setup_of(seed, size.width_px, size.height_px);
            setup.preset = preset;
            const auto frame_at = [=](int index) {
                Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
                spoil(shot);
                return known_frame(shot);
            };
            all.push_back({what, size, frame_at, effort});
        };
        add("whole", [](Shot&) {});
        add("slipped", slip);
        add("slipped, first attempt alone", slip, Preset::nominal, Effort::once);
        add("slipped, hard", slip, Preset::hard);
        for (const double amplitude : {0.02, 0.05, 0.10}) {
            add(fmt::format("wrinkled by {:.2f}", amplitude),
                [=](Shot& shot) { test::wrinkle(amplitude, shot); });
        }
    }
    return all;
}

std::vector<SheetFrames> seams(std::uint64_t seed) {
    std::vector<SheetFrames> all;
    for (const ImageSize size : kSizes) {
        const auto add = [&](const std::string& what, double max_px_from_centre) {
            const auto frame_at = [=](int index) {
                const test::SeamShot shot =
                    test::draw_seam_shot(size.width_px, size.height_px, max_px_from_centre, seed,
                                         static_cast<std::uint64_t>(index));
                return KnownFrame{test::render(shot), shot.truth(), {}, {}};
            };
            all.push_back({what, size, frame_at});
        };
        add("seam anywhere", std::numeric_limits<double>::infinity());
        add("seam within 2 spacings of the reference point", 22);
        add("seam through the reference point", 0);
    }
    return all;
}

bool print_uneven_table(TableRun& run, std::vector<SheetFrames> (*kinds)(std::uint64_t)) {
    std::uint64_t frames = 1000;
    run.add_count("--frames", frames, "Number of frames for each condition");
    run.add_seed();
    run.add_threads();
    if (!run.parse()) return true;

    print_uneven_head();
    int wrong = 0;
    for (const SheetFrames& sheet : kinds(run.seed))
        wrong += print_uneven_row(sheet, frames, run);
    return wrong == 0;
}

}  // namespace

bool slips_table(TableRun& run) {
    return print_uneven_table(run, slips);
}

bool seams_table(TableRun& run) {
    return print_uneven_table(run, seams);
}

}  // namespace dotpose::tables
