// Functions that open each kind of source; frame_source.hpp describes the kinds.
#pragma once

#include "video/frame_source.hpp"

namespace dotpose::video {

std::unique_ptr<FrameSource> open_raw(const SourceOptions& options);
std::unique_ptr<FrameSource> open_images(const SourceOptions& options);
std::unique_ptr<FrameSource> open_video(const SourceOptions& options);
std::unique_ptr<FrameSource> open_camera(const SourceOptions& options);

/// Returns the images of a folder or glob, in the order of their names. Throws Error if the folder
/// cannot be read.
std::vector<std::string> images_at(const std::string& name);

/// Whether the name is a URL of a source in the network.
bool is_url(const std::string& name);

/// Returns the time of a frame in microseconds from its number and the frame rate.
std::int64_t time_of(std::int64_t index, double fps);

}  // namespace dotpose::video
