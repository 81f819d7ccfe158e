// Interface of the module dotpose-video.so, which implements cameras, videos and windows. The
// module is in the program's folder. It is loaded on first use, because loading OpenCV and FFmpeg
// takes a third of a second.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "capture/frame_source.hpp"
#include "dotpose/image.hpp"
#include "video/screen.hpp"

namespace dotpose::video {

using Notify = std::function<void(const std::string&)>;

class GreyVideo {
  public:
    virtual ~GreyVideo() = default;
    /// Appends a frame. Throws Error, for example if the disk is full or the frames differ in size.
    virtual void write(ImageView image) = 0;
    /// Completes the file. Throws Error if frames are missing from it.
    virtual void finish() = 0;
};

/// Functions of the module. They throw Error on failure.
struct Module {
    using OpenSource = std::unique_ptr<capture::FrameSource>(const std::string& name,
                                                             const capture::SourceOptions& options);

    OpenSource* open_camera;
    OpenSource* open_video;
    std::unique_ptr<GreyVideo> (*create_video)(const std::string& path, double fps,
                                               const Notify& notify);
    std::unique_ptr<ScreenOutput> (*open_screen)(const ScreenOptions& options);
};

/// Returns the module. The first call loads it. Throws Error if the module cannot be loaded.
const Module& module();

}  // namespace dotpose::video
