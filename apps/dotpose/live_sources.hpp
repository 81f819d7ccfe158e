/// Access to cameras and videos. Only dotpose-live accesses cameras and videos, because it loads
/// the video module. `dotpose` and dotpose-live have different definitions of these functions.
#pragma once

#include <memory>
#include <string>

#include "capture/frame_source.hpp"
#include "video/module.hpp"

namespace dotpose::cli {

/// In `dotpose`, replaces this process with dotpose-live, with the same command line. Throws Error
/// if dotpose-live is missing. Does nothing in dotpose-live.
void hand_over();

/// Like `hand_over`, but returns if dotpose-live is missing.
void hand_over_if_possible();

/// Opens a camera or video. In `dotpose`, throws Error with the name of the missing program.
std::unique_ptr<capture::FrameSource> open_live(const std::string& name,
                                                const capture::SourceOptions& options);

/// Creates a video, encoded as H.264 if the name ends in .mp4 and as Motion JPEG if it ends in
/// .avi. In `dotpose`, throws Error with the name of the missing program.
std::unique_ptr<video::GreyVideo> create_video(const std::string& path, double fps);

}  // namespace dotpose::cli
