// Sources of frames: cameras, video files, folders of images, raw grey frames in a pipe.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/error.hpp"
#include "dotpose/tools/grey_image.hpp"

namespace dotpose::video {

struct Frame {
    GreyImage image;           ///< empty if the camera does not deliver any frame at the moment
    std::int64_t time_us = 0;  ///< time of the frame on the source's clock; increases
    std::int64_t index = 0;    ///< number of the frame from 0; dropped frames are counted too
    std::string file;          ///< path of an image in a folder
};

/// A rectangle of a frame, in px.
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
    /// Size of raw frames, for which it is required, or the size to ask a camera for. 0: not given.
    int width_px = 0;
    int height_px = 0;
    /// Frames per second to ask a camera for. Of other sources, the frame rate that gives frames
    /// their times; it replaces the times in a video file.
    std::optional<double> fps;
    std::optional<double> exposure;  ///< in the driver's own unit
    std::optional<double> gain;      ///< in the driver's own unit
    std::optional<Region> region;    ///< the part of each frame that is kept
    /// Called from time to time; when it returns true, the source ends.
    std::function<bool()> stop = [] { return false; };
    /// Called with messages for the user while the source goes on, for example that a camera was
    /// unplugged.
    std::function<void(const std::string&)> tell = [](const std::string&) {};
};

class FrameSource {
  public:
    virtual ~FrameSource() = default;

    /// Gets the next frame, or the newest one of a camera. Returns false at the end or when
    /// `SourceOptions::stop` returns true. Throws Error if the source fails, after all
    /// frames before the failure have been returned.
    virtual bool next(Frame& frame) = 0;

    /// Number of frames that were taken but not returned by `next`.
    virtual std::int64_t dropped() const { return 0; }

    /// Frames per second as the source states it, or 0 if it is not known.
    virtual double rate() const { return 0; }
};

/// Returns the files that a source of this name reads: images, a video, or "-"; none for a camera.
std::vector<std::string> files_of(const std::string& name);

/// Opens a source. Throws Error if there is no such source or it cannot be read, and BadArgument if
/// the size of raw frames is not given or the region extends beyond the frame.
std::unique_ptr<FrameSource> open_source(const SourceOptions& options);

/// Returns a part of an image. Throws BadArgument if it extends beyond the image.
GreyImage cropped(const GreyImage& image, const Region& region);

}  // namespace dotpose::video
