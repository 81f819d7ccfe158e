// Times hard frames one by one: most of them take the second attempt, whose time varies much.
#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

#include <fmt/core.h>

#include <dotpose/locate.hpp>

#include "benchmarks.hpp"
#include "frames.hpp"

namespace dotpose::bench {
namespace {

constexpr int kRenderedAtOnce = 500;
constexpr int kLooks = 2;

/// Renders frames from `first` on, and adds their results and times.
void time_frames(int first, int count, SmallMemory& memory, HardTimes& times,
                 std::vector<double>& all_ms) {
    Setup setup;
    setup.preset = Preset::hard;
    setup.seed = kSeed;
    const FrameSource frame_at = frames_of_setup(setup);
    std::vector<KnownFrame> frames(static_cast<std::size_t>(count));
    on_all_cores(count, [&](int i) { frames[static_cast<std::size_t>(i)] = frame_at(first + i); });
    std::vector<double> fastest_ms(frames.size(), std::numeric_limits<double>::max());
    for (int look = 0; look < kLooks; ++look) {
        for (std::size_t i = 0; i < frames.size(); ++i) {
            using Clock = std::chrono::steady_clock;
            const auto start = Clock::now();
            const Fix fix = Locator(memory).locate(frames[i].image.view());
            const std::chrono::duration<double, std::milli> time = Clock::now() - start;
            fastest_ms[i] = std::min(fastest_ms[i], time.count());
            if (look > 0 || fix.status != Status::ok) continue;
            if (!is_right(fix, frames[i].truth)) throw Error("a frame was located wrongly");
            ++times.located;
            times.at_once += fix.attempt == Attempt::first ? 1 : 0;
        }
    }
    all_ms.insert(all_ms.end(), fastest_ms.begin(), fastest_ms.end());
}

}  // namespace

HardTimes time_hard_frames(int frames) {
    HardTimes times;
    times.frames = frames;
    const auto memory = std::make_unique<SmallMemory>();
    std::vector<double> ms;
    for (int first = 0; first < frames; first += kRenderedAtOnce)
        time_frames(first, std::min(kRenderedAtOnce, frames - first), *memory, times, ms);
    std::ranges::sort(ms);
    times.median_ms = quantile(ms, 0.5);
    times.p99_ms = quantile(ms, 0.99);
    times.longest_ms = ms.back();
    return times;
}

std::string hard_table(const HardTimes& t) {
    return "| frames | located, % | of these at once, % | median, ms | 99 %, ms | longest, ms |\n"
           "|--:|--:|--:|--:|--:|--:|\n" +
           fmt::format("| {} | {:.2f} | {:.1f} | {:.2f} | {:.2f} | {:.2f} |\n", t.frames,
                       100.0 * t.located / t.frames, 100.0 * t.at_once / t.located, t.median_ms,
                       t.p99_ms, t.longest_ms);
}

}  // namespace dotpose::bench
