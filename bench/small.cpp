// Measures the time per frame for small cameras, whose frames contain barely enough cells for a
// fix.
#include <algorithm>
#include <memory>

#include <fmt/core.h>

#include <dotpose/locate.hpp>

#include "benchmarks.hpp"
#include "frames.hpp"

namespace dotpose::bench {
namespace {

constexpr double kSpacing_mm = 0.508;  ///< spacing of the dots on the simulated sheet

SmallTimes time_small(int side_px, double spacing_px, int count, int passes) {
    Setup setup;
    setup.seed = kSeed;
    setup.camera.width_px = setup.camera.height_px = side_px;
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
    std::ranges::sort(timed.fastest_us);
    return {side_px,
            spacing_px,
            count,
            timed.located,
            timed.by_first_attempt,
            quantile(timed.fastest_us, 0.5),
            timed.fastest_us.back()};
}

}  // namespace

std::vector<SmallTimes> time_small_frames(bool is_quick) {
    std::vector<SmallTimes> all;
    for (const int side_px : {64, 72, 80, 96}) {
        for (const double spacing_px : {6.0, 7.0, 9.0, 11.0})
            all.push_back(time_small(side_px, spacing_px, is_quick ? 20 : 200, is_quick ? 2 : 7));
    }
    return all;
}

std::string small_table(const std::vector<SmallTimes>& times) {
    std::string table =
        "| frame, px | spacing, px | frames | located, % | by the first attempt, % | median, µs | "
        "longest, µs |\n"
        "|---|--:|--:|--:|--:|--:|--:|\n";
    for (const SmallTimes& t : times) {
        table +=
            fmt::format("| {0} x {0} | {1:.0f} | {2} | {3:.1f} | {4:.1f} | {5:.0f} | {6:.0f} |\n",
                        t.side_px, t.spacing_px, t.frames, 100.0 * t.located / t.frames,
                        100.0 * t.by_first_attempt / t.frames, t.median_us, t.longest_us);
    }
    return table;
}

}  // namespace dotpose::bench
