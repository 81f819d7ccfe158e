#include "reading.hpp"

#include <limits>

namespace dotpose::cli {

Plane plane_of(const Follower& follower) {
    return follower.is_in_world() ? Plane::sheet_world : Plane::pattern;
}

Reading read(const capture::Frame& frame, Follower& follower) {
    const Followed now = follower.follow(frame.image.view(), frame.time_us);
    Reading reading;
    reading.index = frame.index;
    reading.time_us = frame.time_us;
    reading.plane = plane_of(follower);
    reading.track = now.track;
    reading.space_track = now.space_track;
    reading.record = record_of(now.located, follower);
    reading.record.file = frame.file;
    reading.record.elapsed_us = std::numeric_limits<double>::quiet_NaN();
    return reading;
}

}  // namespace dotpose::cli
