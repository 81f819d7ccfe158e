#include "watch_metrics.hpp"

#include <algorithm>
#include <utility>

#include "metrics_text.hpp"

namespace dotpose::cli {

void WatchMetrics::take(Status status, const WatchTally& tally, std::int64_t dropped,
                        double rate_hz) {
    const std::lock_guard lock(mutex_);
    ++frames_[std::min(static_cast<std::size_t>(status), frames_.size() - 1)];
    tally_ = tally;
    dropped_ = dropped;
    rate_hz_ = rate_hz;
}

std::string WatchMetrics::text() const {
    const std::lock_guard lock(mutex_);
    MetricsText text;
    text.counter("dotpose_watch_frames_total", "Frames that were read.", tally_.frames);
    text.begin("dotpose_watch_refused_frames_total", "counter", "Frames without a fix, by status.");
    for (std::size_t i = 1; i < frames_.size(); ++i) {
        const bool is_known = i < static_cast<std::size_t>(kStatusCount);
        const Status status = is_known ? static_cast<Status>(i) : Status::other;
        text.add(frames_[i], label("reason", name(status)));
    }
    text.counter("dotpose_watch_dropped_frames_total",
                 "Frames that were dropped because newer ones arrived.", dropped_);
    text.counter("dotpose_watch_lost_total", "Number of times the robot was lost.", tally_.lost);
    text.gauge("dotpose_watch_frames_per_second", "Rate in the last second.", rate_hz_);
    return std::move(text).finish();
}

}  // namespace dotpose::cli
