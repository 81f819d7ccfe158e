/// Metrics of `dotpose watch --web`. docs/web.md lists them.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>

#include "dotpose/status.hpp"
#include "state_message.hpp"
#include "watch_tally.hpp"

namespace dotpose::cli {

/// Collects the metrics of a run. Thread-safe.
class WatchMetrics {
  public:
    /// Counts a frame with the given status. `tally` already includes the frame. `dropped` is the
    /// total number of dropped frames.
    void take(Status status, const WatchTally& tally, std::int64_t dropped, double rate_hz);

    /// Returns the metrics in the Prometheus text format.
    std::string text() const;

  private:
    mutable std::mutex mutex_;
    RefusedFrames frames_{};  ///< numbers of frames by status, including Status::ok
    WatchTally tally_;
    std::int64_t dropped_ = 0;
    double rate_hz_ = 0;
};

}  // namespace dotpose::cli
