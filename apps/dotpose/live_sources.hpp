/// Access to cameras and videos. Only dotpose-live reads and writes them, because it loads the
/// video module. Each of the two programs has its own definitions of these functions.
#pragma once

#include <memory>
#include <string>

#include "capture/frame_source.hpp"
#include "video/module.hpp"

namespace dotpose::cli {

/// In `dotpose`, replaces this process with dotpose-live and passes on the command line. Throws
/// Error if dotpose-live is missing. Does nothing in dotpose-live.
void hand_over();

/// Like `hand_over`, but returns if dotpose-live is missing.
void hand_over_if_possible();

/// Opens a camera or video. In `dotpose`, throws Error, which names the missing program.
std::unique_ptr<capture::FrameSource> open_live(const std::string& name,
                                                const capture::SourceOptions& options);

/// Creates a video: H.264 if the name ends in .mp4, Motion JPEG if the name ends in .avi. In
/// `dotpose`, throws Error, which names the missing program.
std::unique_ptr<video::GreyVideo> create_video(const std::string& path, double fps);

}  // namespace dotpose::cli
