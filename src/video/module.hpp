// Cameras, videos and windows, implemented in the module dotpose-video.so beside the program.
// OpenCV and FFmpeg take a third of a second to load, so the module is loaded on first use.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "capture/frame_source.hpp"
#include "dotpose/image.hpp"
#include "video/screen.hpp"

namespace dotpose::video {

using Tell = std::function<void(const std::string&)>;

/// An output video file.
class GreyVideo {
  public:
    virtual ~GreyVideo() = default;
    /// Appends a frame. Throws Error, for example if the disk is full or the frames differ in size.
    virtual void write(ImageView image) = 0;
    /// Completes the file. Throws Error if the file is incomplete.
    virtual void finish() = 0;
};

/// Functions of the module. Each function throws Error if it fails.
struct Module {
    using OpenSource = std::unique_ptr<capture::FrameSource>(const std::string& name,
                                                             const capture::SourceOptions& options);

    OpenSource* open_camera;
    OpenSource* open_video;
    std::unique_ptr<GreyVideo> (*create_video)(const std::string& path, double fps,
                                               const Tell& tell);
    std::unique_ptr<ScreenOutput> (*open_screen)(const ScreenOptions& options);
};

/// Returns the module. The first call loads the module and throws Error if loading fails.
const Module& module();

}  // namespace dotpose::video
