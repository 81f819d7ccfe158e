/// Frames: what the benchmarks look at, rendered before time counts.
#pragma once

#include <functional>
#include <vector>

#include <dotpose/tools/evaluate.hpp>
#include <dotpose/tools/simulate.hpp>

namespace dotpose::bench {

/// Of no test and no tuning: these frames are seen here only.
inline constexpr std::uint64_t kSeed = 606;

/// Nominal frames of a camera that the first attempt locates; more of small ones. Rendered once.
const std::vector<KnownFrame>& nominal_frames(const CameraModel& camera);

/// Whether the pose is there, and right.
bool is_right(const Fix& fix, const Truth& truth);

/// Calls work(i) for i from 0 to count - 1, on all cores.
void on_all_cores(int count, const std::function<void(int)>& work);

}  // namespace dotpose::bench
