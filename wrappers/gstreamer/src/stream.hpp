/// Locates the frames of a stream, one after the other.
#pragma once

#include <cstdint>
#include <optional>

#include "dotpose/tools/follower.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "settings.hpp"

namespace dotpose::gstreamer {

/// Result for one frame.
struct Reading {
    std::uint64_t frame = 0;  ///< frame number, counted from 0
    Located located;
    /// Track of the robot. None if each frame is located independently.
    std::optional<Track> track;
    bool is_in_world = false;  ///< true if the track is in the sheet file's world frame
};

class Stream {
  public:
    /// Reads the sheet and camera files. Throws Error if a file cannot be read.
    explicit Stream(const Settings& settings);

    /// Throws BadArgument if the camera file is for a different frame size.
    void require_size(int width_px, int height_px) const;

    /// Locates the next frame. If the time goes backwards, restarts tracking. The image must remain
    /// valid while the trace of `follower` is in use.
    Reading read(ImageView image, bool is_inverted, std::int64_t time_us);

    bool has_overlay() const { return options_.locate.show_stages; }
    /// Returns the number of frames read so far.
    std::uint64_t frames() const { return frames_; }
    /// Returns the follower, which contains the trace of the newest frame.
    const Follower& follower() const { return *follower_; }

  private:
    void copy(ImageView image, bool is_inverted);

    FollowerOptions options_;
    bool is_tracked_;
    std::optional<Follower> follower_;
    GreyImage copy_;
    std::uint64_t frames_ = 0;
    std::int64_t newest_us_ = INT64_MIN;
};

}  // namespace dotpose::gstreamer
