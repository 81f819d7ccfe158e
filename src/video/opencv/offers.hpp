// Functions that dotpose-video.so exports through the table in module_table.cpp.
#pragma once

#include <memory>
#include <string>

#include "video/module.hpp"

namespace dotpose::video {

std::unique_ptr<capture::FrameSource> open_camera(const std::string& name,
                                                  const capture::SourceOptions& options);

std::unique_ptr<capture::FrameSource> open_video(const std::string& name,
                                                 const capture::SourceOptions& options);

/// Creates a video file in H.264 or MPEG-4, or in Motion JPEG if the name ends in .avi.
std::unique_ptr<GreyVideo> create_video(const std::string& path, double fps, const Notify& notify);

std::unique_ptr<ScreenOutput> open_screen(const ScreenOptions& options);

}  // namespace dotpose::video
