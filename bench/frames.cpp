#include "frames.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <thread>
#include <tuple>

#include <dotpose/locate.hpp>

namespace dotpose::bench {
namespace {

/// Returns the number of frames to render. The number is large enough that caches and branch
/// prediction do not adapt to individual frames, and small enough that rendering is quick.
int count_of(const CameraModel& camera) {
    constexpr int kMaxFrames = 20;
    constexpr int kPixels = 4'000'000;
    return std::clamp(kPixels / (camera.width_px * camera.height_px), 1, kMaxFrames);
}

/// Returns true if both the first attempt and the attempt of DeviceLocator find a pose. Other
/// frames are excluded, because an attempt that fails early would appear fast.
bool is_located_by_first_attempt(const KnownFrame& frame) {
    const auto memory = std::make_unique<LargeMemory>();
    const auto locates = [&](Effort effort) {
        DeviceOptions options;
        options.effort = effort;
        return Locator(*memory, options).locate(frame.image.view()).status == Status::ok;
    };
    return locates(Effort::once) && locates(Effort::device);
}

}  // namespace

const std::vector<KnownFrame>& nominal_frames(const CameraModel& camera) {
    static std::map<std::tuple<int, int, double>, std::vector<KnownFrame>> rendered;
    auto& frames = rendered[{camera.width_px, camera.height_px, camera.mm_per_px}];
    if (frames.empty()) {
        Setup setup;
        setup.seed = kSeed;
        setup.camera = camera;
        const FrameSource frame_at = frames_of_setup(setup);
        const int count = count_of(camera);
        frames = render_frames(count, [&](int draw) {
            KnownFrame frame = frame_at(draw);
            while (!is_located_by_first_attempt(frame))
                frame = frame_at(draw += count);
            return frame;
        });
    }
    return frames;
}

bool is_right(const Fix& fix, const Truth& truth) {
    Outcome outcome;
    outcome.fix = fix;
    outcome.truth = truth;
    return outcome.is_fix() && !outcome.is_wrong();
}

double quantile(const std::vector<double>& sorted, double probability) {
    const double rank = std::ceil(probability * static_cast<double>(sorted.size()));
    return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

std::vector<KnownFrame> render_frames(int count, const FrameSource& frame_at) {
    std::vector<KnownFrame> frames(static_cast<std::size_t>(count));
    on_all_cores(count, [&](int i) { frames[static_cast<std::size_t>(i)] = frame_at(i); });
    return frames;
}

TimedFrames time_frames(const std::vector<KnownFrame>& frames, int passes,
                        const std::function<Fix(const ImageView&)>& locate) {
    using Clock = std::chrono::steady_clock;
    TimedFrames times;
    times.fastest_us.assign(frames.size(), std::numeric_limits<double>::max());
    times.fixes.resize(frames.size());
    for (int pass = 0; pass < passes; ++pass) {
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const auto start = Clock::now();
            const Fix fix = locate(frames[i].image.view());
            const std::chrono::duration<double, std::micro> elapsed = Clock::now() - start;
            times.fastest_us[i] = std::min(times.fastest_us[i], elapsed.count());
            times.fixes[i] = fix;
            if (pass > 0 || fix.status != Status::ok) continue;
            if (!is_right(fix, frames[i].truth)) throw Error("a frame was located wrongly");
            ++times.located;
            times.by_first_attempt += fix.attempt == Attempt::first ? 1 : 0;
        }
    }
    return times;
}

void on_all_cores(int count, const std::function<void(int)>& work) {
    std::atomic<int> next{0};
    const auto run = [&] {
        for (int i = next++; i < count; i = next++)
            work(i);
    };
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < std::thread::hardware_concurrency(); ++i)
        threads.emplace_back(run);
}

}  // namespace dotpose::bench
