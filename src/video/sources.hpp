// One function for each kind of source; see frame_source.hpp.
#pragma once

#include "video/frame_source.hpp"

namespace dotpose::video {

std::unique_ptr<FrameSource> open_raw(const SourceOptions& options);
std::unique_ptr<FrameSource> open_images(const SourceOptions& options);
std::unique_ptr<FrameSource> open_video(const SourceOptions& options);
std::unique_ptr<FrameSource> open_camera(const SourceOptions& options);

/// The images of a folder or glob, in the order of their names. Throws Error: the folder cannot be
/// read.
std::vector<std::string> images_at(const std::string& name);

/// Whether the name is that of something in the network.
bool is_url(const std::string& name);

/// Time of a frame where only its number is known.
std::int64_t time_of(std::int64_t index, double fps);

}  // namespace dotpose::video
