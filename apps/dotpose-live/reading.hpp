/// The results of `dotpose watch` for one frame: the fix of that frame, and the track up to it.
#pragma once

#include <cstdint>

#include "capture/frame_source.hpp"
#include "dotpose/tools/follower.hpp"
#include "locate_record.hpp"

namespace dotpose::cli {

/// The plane of a track: the pattern, or the world of a sheet file.
enum class Plane { pattern, sheet_world };
Plane plane_of(const Follower& follower);

struct Reading {
    std::int64_t index = 0;
    std::int64_t time_us = 0;
    Record record;  ///< `p_wrong` with the tracker's prior, where the fix needed that
    Track track;
    Plane plane = Plane::pattern;
};

/// Follows the robot to this frame.
Reading read(const capture::Frame& frame, Follower& follower);

}  // namespace dotpose::cli
