/// Cameras and videos, which the program in apps/dotpose-live reads and writes, as it loads the
/// module for them. Each of the two programs defines these functions.
#pragma once

#include <memory>
#include <string>

#include "capture/frame_source.hpp"
#include "video/module.hpp"

namespace dotpose::cli {

/// In `dotpose`, replaces this process by dotpose-live with the same command line. Throws Error if
/// that program is missing. In dotpose-live, does nothing.
void hand_over();

/// Like `hand_over`, but returns if dotpose-live is missing.
void hand_over_if_possible();

/// Opens a camera or video. In `dotpose`, throws Error that says what is missing.
std::unique_ptr<capture::FrameSource> open_live(const std::string& name,
                                                const capture::SourceOptions& options);

/// Creates a video: H.264 if the name ends in .mp4, Motion JPEG if it ends in .avi. In `dotpose`,
/// throws Error that says what is missing.
std::unique_ptr<video::GreyVideo> create_video(const std::string& path, double fps);

}  // namespace dotpose::cli
