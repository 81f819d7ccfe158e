// Measures the time per frame for small cameras, whose frames contain barely enough cells for a
// fix.
#include <algorithm>
#include <memory>
#include <span>

#include <fmt/core.h>

#include <dotpose/locate.hpp>

#include "benchmarks.hpp"
#include "frames.hpp"

namespace dotpose::bench {
namespace {

constexpr double kSpacing_mm = 0.508;  ///< spacing of the dots on the simulated sheet

SmallTimes time_small(int width_px, int height_px, double spacing_px, int count, int passes) {
    Setup setup;
    setup.seed = kSeed;
    setup.camera.width_px = width_px;
    setup.camera.height_px = height_px;
    setup.camera.mm_per_px = kSpacing_mm / spacing_px;
    const auto memory = std::make_unique<SmallMemory>();
    TimedFrames timed = time_frames(
        render_frames(count,
                      [&](int i) {
                          const Shot shot = draw_shot(setup, static_cast<std::uint64_t>(i));
                          return KnownFrame{render(shot), truth_of(shot), {}, {}};
                      }),
        passes,
        [&](const ImageView& image) { return Locator(*memory, DeviceOptions{}).locate(image); });
    double longest_first_us = 0;
    for (std::size_t i = 0; i < timed.attempts.size(); ++i) {
        if (timed.attempts[i] == Attempt::first)
            longest_first_us = std::max(longest_first_us, timed.fastest_us[i]);
    }
    std::ranges::sort(timed.fastest_us);
    return {width_px,
            height_px,
            spacing_px,
            count,
            timed.located,
            timed.by_first_attempt,
            quantile(timed.fastest_us, 0.5),
            longest_first_us,
            timed.fastest_us.back()};
}

}  // namespace

std::vector<SmallTimes> time_small_frames(bool is_quick) {
    const int count = is_quick ? 20 : 200;
    const int passes = is_quick ? 2 : 15;
    std::vector<SmallTimes> all = {time_small(188, 120, 11, count, passes)};
    for (const int side_px : {64, 72, 80, 96}) {
        for (const double spacing_px : {6.0, 7.0, 9.0, 11.0})
            all.push_back(time_small(side_px, side_px, spacing_px, count, passes));
    }
    return all;
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
            "| {} x {} | {:.0f} | {} | {:.1f} | {:.1f} | {:.0f} | {:.0f} | {:.1f} | {:.0f} |\n",
            t.width_px, t.height_px, t.spacing_px, t.frames, 100.0 * t.located / t.frames,
            100.0 * t.by_first_attempt / t.frames, t.median_us, t.longest_first_us,
            t.longest_first_us / times.front().median_us, t.longest_us);
    }
    return table;
}

}  // namespace dotpose::bench
