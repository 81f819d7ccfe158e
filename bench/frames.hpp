/// The frames of the benchmarks, which are rendered before the measurement begins.
#pragma once

#include <functional>
#include <vector>

#include <dotpose/tools/evaluate.hpp>
#include <dotpose/tools/simulate.hpp>

namespace dotpose::bench {

/// A seed that no test and no tuning uses.
inline constexpr std::uint64_t kSeed = 606;

/// Returns nominal frames of a camera that the first attempt locates; the number is larger for
/// small frames. They are rendered at the first call.
const std::vector<KnownFrame>& nominal_frames(const CameraModel& camera);

/// Whether there is a pose and it is right.
bool is_right(const Fix& fix, const Truth& truth);

/// Returns a quantile of sorted values, by the nearest rank.
double quantile(const std::vector<double>& sorted, double share);

/// Calls `work(i)` for i from 0 to count - 1, on all cores.
void on_all_cores(int count, const std::function<void(int)>& work);

}  // namespace dotpose::bench
