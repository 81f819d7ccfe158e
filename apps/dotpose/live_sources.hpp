/// Access to cameras and videos. The functions are implemented differently in `dotpose` and
/// dotpose-live, because only dotpose-live loads the video module.
#pragma once

#include <memory>
#include <string>

#include "capture/frame_source.hpp"
#include "video/module.hpp"

namespace dotpose::cli {

/// In `dotpose`, replaces this process with dotpose-live, passing the same command line, or throws
/// Error if dotpose-live is missing. In dotpose-live, does nothing.
void hand_over();

/// Like `hand_over`, but returns if dotpose-live is missing.
void hand_over_if_possible();

/// Opens a camera or a video. In `dotpose`, throws Error, because only dotpose-live can read
/// cameras and videos.
std::unique_ptr<capture::FrameSource> open_live(const std::string& name,
                                                const capture::SourceOptions& options);

/// Creates a video file: H.264 if the name ends in .mp4, and Motion JPEG if it ends in .avi. Throws
/// Error if called in `dotpose`, because only dotpose-live can write videos.
std::unique_ptr<video::GreyVideo> create_video(const std::string& path, double fps);

}  // namespace dotpose::cli
