// Where frames come from: cameras, video files, folders of images, raw grey frames in a pipe.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/tools/error.hpp"
#include "dotpose/tools/grey_image.hpp"

namespace dotpose::video {

struct Frame {
    GreyImage image;           ///< empty: time goes by, and the camera gives nothing
    std::int64_t time_us = 0;  ///< of the frame itself, on the source's clock; increases
    std::int64_t index = 0;    ///< counts the source's frames from 0, those that were dropped too
    std::string file;          ///< of an image in a folder
};

/// Part of a frame, in px.
struct Region {
    int left = 0;
    int top = 0;
    int width = 0;
    int height = 0;
};

struct SourceOptions {
    /// A camera's number, device (/dev/video...) or URL (http://..., rtsp://...), a video file, a
    /// folder or glob of images, or "-" for raw frames on standard input.
    std::string name;
    /// Of raw frames, where they are required, and of what a camera is asked for. 0: not given.
    int width_px = 0;
    int height_px = 0;
    /// Frames per second: asked of a camera; where frames have no time of their own it gives them
    /// one. Of a video file it takes the place of the times in the file.
    std::optional<double> fps;
    std::optional<double> exposure;  ///< in the driver's own unit
    std::optional<double> gain;      ///< the same
    std::optional<Region> region;    ///< all that is kept of a frame
    /// Asked now and then; true ends the source.
    std::function<bool()> stop = [] { return false; };
    /// Told what the user should know while it goes on: a camera that was unplugged.
    std::function<void(const std::string&)> tell = [](const std::string&) {};
};

class FrameSource {
  public:
    virtual ~FrameSource() = default;

    /// The next frame; of a camera the newest. False at the end or when asked to stop.
    /// Throws Error if the source fails, after it has given all frames before the fault.
    virtual bool next(Frame& frame) = 0;

    /// Frames that were taken but never given.
    virtual std::int64_t dropped() const { return 0; }

    /// Frames per second as the source states it; 0: unknown.
    virtual double rate() const { return 0; }
};

/// The files that a source of this name reads: images, a video, "-"; none of a camera.
std::vector<std::string> files_of(const std::string& name);

/// Throws Error: there is no such source, or it cannot be read; BadArgument: raw frames need a
/// size, the region leaves the frame.
std::unique_ptr<FrameSource> open_source(const SourceOptions& options);

/// The part of an image. Throws BadArgument if it leaves the image.
GreyImage cropped(const GreyImage& image, const Region& region);

}  // namespace dotpose::video
