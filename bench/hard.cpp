// Measures the time of each hard frame. Most hard frames need the second attempt, whose time varies
// widely.
#include <algorithm>
#include <memory>

#include <fmt/core.h>

#include <dotpose/locate.hpp>

#include "benchmarks.hpp"
#include "frames.hpp"

namespace dotpose::bench {

HardTimes time_hard_frames(int frames) {
    // Renders the frames in batches to limit memory use.
    constexpr int kMaxRendered = 500;
    constexpr int kPasses = 2;
    Setup setup;
    setup.preset = Preset::hard;
    setup.seed = kSeed;
    const FrameSource frame_at = frames_of_setup(setup);
    const auto memory = std::make_unique<SmallMemory>();
    HardTimes times;
    times.frames = frames;
    std::vector<double> us;
    for (int first = 0; first < frames; first += kMaxRendered) {
        const int count = std::min(kMaxRendered, frames - first);
        const TimedFrames part =
            time_frames(render_frames(count, [&](int i) { return frame_at(first + i); }), kPasses,
                        [&](const ImageView& image) {
                            return Locator(*memory, DeviceOptions{}).locate(image);
                        });
        times.located += part.located;
        times.by_first_attempt += part.by_first_attempt;
        us.insert(us.end(), part.fastest_us.begin(), part.fastest_us.end());
    }
    std::ranges::sort(us);
    times.median_ms = quantile(us, 0.5) / 1000;
    times.p99_ms = quantile(us, 0.99) / 1000;
    times.longest_ms = us.back() / 1000;
    return times;
}

std::string hard_table(const HardTimes& t) {
    return "| frames | located, % | of these by the first attempt, % | median, ms | 99 %, ms | "
           "longest, ms |\n"
           "|--:|--:|--:|--:|--:|--:|\n" +
           fmt::format("| {} | {:.2f} | {:.1f} | {:.2f} | {:.2f} | {:.2f} |\n", t.frames,
                       100.0 * t.located / t.frames, 100.0 * t.by_first_attempt / t.located,
                       t.median_ms, t.p99_ms, t.longest_ms);
}

}  // namespace dotpose::bench
