/// Counts located and refused frames by status, for each second of the last two minutes.
#pragma once

#include <cstdint>
#include <deque>
#include <map>

#include "dotpose/status.hpp"

namespace dotpose::cli {

class RefusalHistory {
  public:
    /// Number of seconds to keep.
    static constexpr std::int64_t kSeconds = 120;

    struct Second {
        std::int64_t second = 0;  ///< time on the clock of the source, in whole seconds
        std::map<Status, std::int64_t> frames;
    };

    /// Adds a frame to the counts for the second in which the frame was captured. A frame that is
    /// older than the newest second is added to the newest second.
    void add(std::int64_t time_us, Status status);

    /// Returns all seconds that contain frames, oldest first.
    const std::deque<Second>& seconds() const { return seconds_; }

  private:
    std::deque<Second> seconds_;
};

}  // namespace dotpose::cli
