/// Result of `dotpose watch` for one frame: the record of the frame and the updated track.
#pragma once

#include <cstdint>

#include "capture/frame_source.hpp"
#include "dotpose/tools/follower.hpp"
#include "locate_record.hpp"

namespace dotpose::cli {

/// Frame of reference of a track: the pattern frame, or the world frame of a sheet file.
enum class Plane { pattern, sheet_world };
Plane plane_of(const Follower& follower);

struct Reading {
    std::int64_t index = 0;
    std::int64_t time_us = 0;
    /// Result for the frame. If the fix was accepted only with the tracker's prior (`with_prior` in
    /// dotpose/track.hpp), `p_wrong` is the bound that includes this prior.
    Record record;
    Track track;
    std::optional<SpaceTrack> space_track;  ///< see Followed
    Plane plane = Plane::pattern;
};

/// Locates the frame and updates the track.
Reading read(const capture::Frame& frame, Follower& follower);

}  // namespace dotpose::cli
