// Opens the sources of frames that need the libraries for cameras and videos.
#pragma once

#include <memory>
#include <string>

#include "capture/frame_source.hpp"

namespace dotpose::video {

/// A file. Throws Error if it cannot be read or is no video.
std::unique_ptr<capture::FrameSource> open_video(const std::string& name,
                                                 const capture::SourceOptions& options);

/// A camera's number, device (/dev/video...) or URL (http://..., rtsp://...). Throws Error if it
/// cannot be opened.
std::unique_ptr<capture::FrameSource> open_camera(const std::string& name,
                                                  const capture::SourceOptions& options);

}  // namespace dotpose::video
