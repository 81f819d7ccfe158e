// Measures how many frames are needed to locate a moving camera if a single view is too small for a
// fix. The bits of successive frames are combined. Prints a table in Markdown.
//
//   dotpose_tables together [--series N] [--seed S]
//
// The exit status is 1 if a fix is wrong.
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "dotpose/tools/simulate.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

/// Number of frames in a series.
constexpr std::size_t kLength = 8;
/// An A4 page.
constexpr KnownRegion kSheet{CodeVariant::anoto, {}, {1024, 1024}, 393, 564};
constexpr std::uint32_t kMargin = 60;

/// A kind of series: the spacing and size of its views, whether they are on a known sheet, and the
/// standard deviations of the measured motion between consecutive views.
struct SeriesKind {
    double spacing_px;
    int side_px;
    bool is_on_sheet;
    float sigma_mm;
    float sigma_rad;
};

constexpr std::array kKinds{
    SeriesKind{11, 96, false, 0.02F, 0.005F}, SeriesKind{11, 80, false, 0.02F, 0.005F},
    SeriesKind{11, 66, false, 0.02F, 0.005F}, SeriesKind{11, 80, false, 0.5F, 0.1F},
    SeriesKind{11, 66, true, 0.02F, 0.005F},  SeriesKind{11, 54, true, 0.02F, 0.005F},
    SeriesKind{11, 54, true, 0.5F, 0.1F},     SeriesKind{6, 30, true, 0.02F, 0.005F},
};

struct SeriesTally {
    std::uint64_t series = 0;
    /// located[k] is the number of series with at least one fix in the first k + 1 frames.
    std::array<std::uint64_t, kLength> located{};
    std::uint64_t fixes = 0;
    std::uint64_t wrong = 0;

    void operator+=(const SeriesTally& other) {
        series += other.series;
        for (std::size_t k = 0; k < kLength; ++k)
            located[k] += other.located[k];
        fixes += other.fixes;
        wrong += other.wrong;
    }
};

Shot draw_first(const SeriesKind& kind, std::uint64_t seed, std::uint64_t index) {
    Setup setup = tables::setup_of(seed, kind.side_px, kind.side_px);
    setup.camera.mm_per_px = setup.pattern.spacing_mm / kind.spacing_px;
    Shot shot = draw_shot(setup, index);
    if (kind.is_on_sheet) {
        Rng rng(shot.seed, 1);
        shot.page.pattern.section = kSheet.section;
        shot.pose.cell = {kSheet.first.x + kMargin + rng.below(kSheet.columns - 2 * kMargin),
                          kSheet.first.y + kMargin + rng.below(kSheet.rows - 2 * kMargin)};
    }
    return shot;
}

/// Moves the camera by half the side of a view in a random direction and turns it. Returns the
/// motion with simulated measurement errors.
MeasuredMotion move(const SeriesKind& kind, Shot& shot, Rng& rng) {
    CameraPose& pose = shot.pose;
    const double distance_mm = kind.side_px * shot.camera.mm_per_px / 2;
    const double direction_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    const double turn_rad = rng.uniform(-0.5, 0.5);
    const double spacing_mm = shot.page.pattern.spacing_mm;
    const auto add = [&](double grid, std::uint32_t& cell, double& fraction) {
        const double whole = std::floor(fraction + grid);
        cell = static_cast<std::uint32_t>(cell + static_cast<std::int64_t>(whole));
        fraction += grid - whole;
    };
    add(distance_mm / spacing_mm * std::cos(pose.theta_rad + direction_rad), pose.cell.x,
        pose.fraction_x);
    add(distance_mm / spacing_mm * std::sin(pose.theta_rad + direction_rad), pose.cell.y,
        pose.fraction_y);
    pose.theta_rad = std::remainder(pose.theta_rad + turn_rad, 2 * std::numbers::pi);
    ++shot.seed;
    const auto noise = [&](float sigma) { return static_cast<double>(sigma) * rng.normal(); };
    return {
        .right_mm =
            static_cast<float>(distance_mm * std::cos(direction_rad) + noise(kind.sigma_mm)),
        .down_mm = static_cast<float>(distance_mm * std::sin(direction_rad) + noise(kind.sigma_mm)),
        .turn_rad = static_cast<float>(turn_rad + noise(kind.sigma_rad)),
        .sigma_mm = kind.sigma_mm,
        .sigma_rad = kind.sigma_rad};
}

void run_series(const SeriesKind& kind, std::uint64_t seed, std::uint64_t index,
                SeriesTally& tally) {
    Locator locator(thread_memory(), DeviceOptions{});
    if (kind.is_on_sheet)
        static_cast<void>(locator.set_known({&kSheet, 1}, OtherSheets::impossible));
    Shot shot = draw_first(kind, seed, index);
    Rng rng(shot.seed, 2);
    MeasuredMotion motion;
    bool is_located = false;
    ++tally.series;
    for (std::size_t k = 0; k < kLength; ++k) {
        Outcome outcome;
        outcome.fix = locator.locate(render(shot).view(), motion);
        outcome.truth = truth_of(shot);
        is_located |= outcome.is_fix();
        tally.fixes += outcome.is_fix();
        tally.wrong += outcome.is_wrong();
        tally.located[k] += is_located;
        motion = move(kind, shot, rng);
    }
}

}  // namespace

bool together_table(TableRun& run) {
    std::uint64_t series = 500;
    run.add_count("--series", series, "Number of series of each kind");
    run.add_seed();
    run.add_threads();
    if (!run.parse()) return true;
    fmt::print(
        "| places | spacing, px | view, px | sigma of the motion | located by frame 1 | 2 | 3 | 4 "
        "| 8, % | fixes | wrong |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
    bool is_right = true;
    for (const SeriesKind& kind : kKinds) {
        const auto count = run.count<SeriesTally>(
            "series", series,
            [&](std::uint64_t i, SeriesTally& tally) { run_series(kind, run.seed, i, tally); });
        const SeriesTally& tally = count.tally;
        const auto percent = [&](std::size_t frame) {
            return 100.0 * static_cast<double>(tally.located[frame - 1]) /
                   static_cast<double>(tally.series);
        };
        fmt::print(
            "| {} | {} | {} x {} | {} mm, {} rad | {:.1f} | {:.1f} | {:.1f} | {:.1f} | "
            "{:.1f} | {} | {} |\n",
            kind.is_on_sheet ? "one A4 page" : "whole plane", kind.spacing_px, kind.side_px,
            kind.side_px, kind.sigma_mm, kind.sigma_rad, percent(1), percent(2), percent(3),
            percent(4), percent(8), tally.fixes, tally.wrong);
        std::fflush(stdout);
        is_right &= tally.wrong == 0 && count.is_complete();
    }
    return is_right;
}

}  // namespace dotpose::tables
