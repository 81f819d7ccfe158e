/// Counts the frames, fixes and events of a run.
#pragma once

#include <cstdint>

#include "reading.hpp"

namespace dotpose::cli {

struct WatchTally {
    std::int64_t frames = 0;
    std::int64_t fixes = 0;
    std::int64_t lost = 0;
    std::int64_t kidnapped = 0;

    void count(const Reading& reading) {
        ++frames;
        fixes += reading.record.fix.status == Status::ok;
        lost += reading.track.events.lost;
        kidnapped += reading.track.events.kidnapped;
    }
};

}  // namespace dotpose::cli
