// Measures the time per frame for small cameras, whose frames contain barely enough cells for a
// fix.
#include <algorithm>
#include <iterator>
#include <memory>
#include <numbers>
#include <span>

#include <fmt/core.h>

#include <dotpose/locate.hpp>

#include "benchmarks.hpp"
#include "frames.hpp"

namespace dotpose::bench {
namespace {

constexpr double kSpacing_mm = 0.508;  ///< spacing of the dots on the simulated sheet

/// Turns the camera until the rows of dots are parallel to the image, except for an angle of up to
/// 0.4 degrees that depends only on the shot.
void make_parallel(Shot& shot) {
    constexpr double kRadPerDeg = std::numbers::pi / 180;
    constexpr double kMax_deg = 0.4;
    shot.pose.theta_rad = Rng(shot.seed, 1).uniform(-kMax_deg, kMax_deg) * kRadPerDeg;
}

/// Renders the frames of a row, and appends them to `frames`.
void add_frames(const SmallTimes& row, std::vector<KnownFrame>& frames) {
    Setup setup;
    setup.seed = kSeed;
    setup.camera.width_px = row.width_px;
    setup.camera.height_px = row.height_px;
    setup.camera.mm_per_px = kSpacing_mm / row.spacing_px;
    std::ranges::move(render_frames(row.frames,
                                    [&](int i) {
                                        Shot shot = draw_shot(setup, static_cast<std::uint64_t>(i));
                                        if (row.is_parallel) make_parallel(shot);
                                        return KnownFrame{render(shot), truth_of(shot), {}, {}};
                                    }),
                      std::back_inserter(frames));
}

/// Computes the results of a row from its times and fixes.
void summarize(std::span<const double> fastest_us, std::span<const Fix> fixes, SmallTimes& row) {
    std::vector<double> sorted_us(fastest_us.begin(), fastest_us.end());
    std::ranges::sort(sorted_us);
    row.median_us = quantile(sorted_us, 0.5);
    row.longest_us = sorted_us.back();
    for (std::size_t i = 0; i < fixes.size(); ++i) {
        const bool is_located = fixes[i].status == Status::ok;
        const bool is_first = fixes[i].attempt == Attempt::first;
        row.located += is_located ? 1 : 0;
        row.by_first_attempt += is_located && is_first ? 1 : 0;
        if (is_first) row.longest_first_us = std::max(row.longest_first_us, fastest_us[i]);
    }
}

}  // namespace

std::vector<SmallTimes> time_small_frames(bool is_quick) {
    const int count = is_quick ? 20 : 200;
    const int passes = is_quick ? 2 : 15;
    std::vector<SmallTimes> rows = {{188, 120, 11, count}};
    for (const int side_px : {64, 72, 80, 96}) {
        for (const double spacing_px : {6.0, 7.0, 9.0, 11.0})
            rows.push_back({side_px, side_px, spacing_px, count});
    }
    rows.push_back({80, 80, 5, count, true});
    rows.push_back({96, 96, 6, count, true});
    std::vector<KnownFrame> frames;
    for (const SmallTimes& row : rows)
        add_frames(row, frames);
    const auto memory = std::make_unique<SmallMemory>();
    const TimedFrames timed = time_frames(frames, passes, [&](const ImageView& image) {
        return Locator(*memory, DeviceOptions{}).locate(image);
    });
    std::size_t first = 0;
    for (SmallTimes& row : rows) {
        const auto n = static_cast<std::size_t>(row.frames);
        summarize(std::span(timed.fastest_us).subspan(first, n),
                  std::span(timed.fixes).subspan(first, n), row);
        first += n;
    }
    return rows;
}

double longest_first_ratio(const std::vector<SmallTimes>& times) {
    double longest_us = 0;
    for (const SmallTimes& t : std::span(times).subspan(1))
        longest_us = std::max(longest_us, t.longest_first_us);
    return longest_us / times.front().median_us;
}

std::string small_table(const std::vector<SmallTimes>& times) {
    std::string table =
        "| frame, px | spacing, px | frames | located, % | by the first attempt, % | median, µs | "
        "longest without a second attempt, µs | / median of 188 x 120 | longest, µs |\n"
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    for (const SmallTimes& t : times) {
        table += fmt::format(
            "| {} x {}{} | {:.0f} | {} | {:.1f} | {:.1f} | {:.0f} | {:.0f} | {:.1f} | {:.0f} |\n",
            t.width_px, t.height_px, t.is_parallel ? ", parallel" : "", t.spacing_px, t.frames,
            100.0 * t.located / t.frames, 100.0 * t.by_first_attempt / t.frames, t.median_us,
            t.longest_first_us, t.longest_first_us / times.front().median_us, t.longest_us);
    }
    return table;
}

}  // namespace dotpose::bench
