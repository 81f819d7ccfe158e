// Cameras, videos and windows: the module dotpose-video.so beside the program. OpenCV and FFmpeg
// take a third of a second to load, so it is loaded when the first of them is used.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "capture/frame_source.hpp"
#include "dotpose/image.hpp"
#include "video/screen.hpp"

namespace dotpose::video {

using Tell = std::function<void(const std::string&)>;

/// A video file that is being written.
class GreyVideo {
  public:
    virtual ~GreyVideo() = default;
    /// Throws Error, as on a full disk or if the frames differ in size.
    virtual void write(ImageView image) = 0;
    /// Throws Error if the file is not complete.
    virtual void finish() = 0;
};

/// The functions of the module. Each throws Error if it fails.
struct Module {
    using OpenSource = std::unique_ptr<capture::FrameSource>(const std::string& name,
                                                             const capture::SourceOptions& options);

    OpenSource* open_camera;
    OpenSource* open_video;
    std::unique_ptr<GreyVideo> (*create_video)(const std::string& path, double fps,
                                               const Tell& tell);
    std::unique_ptr<ScreenOutput> (*open_screen)(const ScreenOptions& options);
};

/// Returns the module, which it loads first if need be. Throws Error if that fails.
const Module& module();

}  // namespace dotpose::video
