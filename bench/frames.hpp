/// Frames for the benchmarks. They are rendered before the measurement begins.
#pragma once

#include <functional>
#include <vector>

#include <dotpose/tools/evaluate.hpp>
#include <dotpose/tools/simulate.hpp>

namespace dotpose::bench {

/// Seed of the frames. No test uses this seed, and no parameter was tuned with it.
inline constexpr std::uint64_t kSeed = 606;

/// Returns 20 nominal frames, or fewer if a frame has more than 200,000 px. All of them are located
/// both by the first attempt and by the attempt of DeviceLocator. The first call for a camera
/// renders the frames, and later calls return the same frames.
const std::vector<KnownFrame>& nominal_frames(const CameraModel& camera);

/// Returns true if the fix has a pose and that pose is correct.
bool is_right(const Fix& fix, const Truth& truth);

/// Returns the quantile of sorted values for the given probability, by the nearest-rank method.
double quantile(const std::vector<double>& sorted, double probability);

/// Calls `work(i)` for i from 0 to count - 1, on all cores.
void on_all_cores(int count, const std::function<void(int)>& work);

/// Renders the frames frame_at(0) to frame_at(count - 1) on all cores.
std::vector<KnownFrame> render_frames(int count, const FrameSource& frame_at);

/// Results of locating each frame several times and measuring the time of each call.
struct TimedFrames {
    int located = 0;
    int by_first_attempt = 0;        ///< number of frames located by the first attempt
    std::vector<double> fastest_us;  ///< shortest time of each frame over all passes
    std::vector<Fix> fixes;          ///< result of the last pass for each frame
};
/// Locates all frames `passes` times with `locate`. Throws Error if a fix is wrong.
TimedFrames time_frames(const std::vector<KnownFrame>& frames, int passes,
                        const std::function<Fix(const ImageView&)>& locate);

}  // namespace dotpose::bench
