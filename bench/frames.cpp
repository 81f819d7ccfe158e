#include "frames.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <memory>
#include <thread>
#include <tuple>

#include <dotpose/locate.hpp>

namespace dotpose::bench {
namespace {

/// Returns the number of frames to render: enough that branch prediction and caches do not adapt to
/// single frames, but few enough to be rendered quickly.
int count_of(const CameraModel& camera) {
    constexpr int kMost = 20;
    constexpr int kPixels = 4'000'000;
    return std::clamp(kPixels / (camera.width_px * camera.height_px), 1, kMost);
}

/// Whether the first attempt finds a pose. Frames without a pose are left out, because the attempt
/// may end early on them and would seem fast.
bool is_located_at_once(const KnownFrame& frame) {
    const auto memory = std::make_unique<LargeMemory>();
    const auto locates = [&](Effort effort) {
        Options options;
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
        frames.resize(static_cast<std::size_t>(count));
        on_all_cores(count, [&](int i) {
            KnownFrame& frame = frames[static_cast<std::size_t>(i)];
            int draw = i;
            do {
                frame = frame_at(draw);
                draw += count;
            } while (!is_located_at_once(frame));
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

double quantile(const std::vector<double>& sorted, double share) {
    const double rank = std::ceil(share * static_cast<double>(sorted.size()));
    return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
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
