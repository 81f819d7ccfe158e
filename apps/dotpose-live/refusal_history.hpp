/// Counts located and refused frames by reason, for each second of the last minutes.
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
        std::int64_t second = 0;  ///< time in s on the clock of the source, rounded down
        std::map<Status, std::int64_t> frames;
    };

    /// Counts a frame in the second of its time. A frame that is older than the newest second is
    /// counted in this second.
    void add(std::int64_t time_us, Status status);

    /// Returns the seconds with frames, oldest first.
    const std::deque<Second>& seconds() const { return seconds_; }

  private:
    std::deque<Second> seconds_;
};

}  // namespace dotpose::cli
