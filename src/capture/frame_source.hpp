// Frame sources: image files, folders of images, and raw grey frames from a pipe. The `video` layer
// adds cameras and video files.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dotpose/files/error.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/grey_image.hpp"

namespace dotpose::capture {

struct Frame {
    GreyImage image;           ///< empty while the camera delivers no frames
    std::int64_t time_us = 0;  ///< time on the source's clock; increases with each frame
    std::int64_t index = 0;    ///< number of preceding frames, including dropped frames
    std::string file;          ///< path of the image file, or empty for other sources
    bool is_live = false;      ///< true if `time_us` is on the monotonic clock of this computer
};

/// A rectangle of a frame, in px.
struct Region {
    int left = 0;
    int top = 0;
    int width = 0;
    int height = 0;
};

class FrameSource {
  public:
    virtual ~FrameSource() = default;

    /// Gets the next frame, or, if the source is a camera, its newest frame. Returns false at the
    /// end of the source, or when `SourceOptions::stop` returns true. If the source fails, returns
    /// the frames captured before the failure, and then throws Error.
    virtual bool next(Frame& frame) = 0;

    /// Returns the number of frames that were captured but not returned by `next`.
    virtual std::int64_t dropped() const { return 0; }

    /// Returns the frame rate reported by the source, in frames per second, or 0 if unknown.
    virtual double rate() const { return 0; }

    /// Returns the mean number of bits per pixel in the compressed frames delivered so far, or 0 if
    /// the number is unknown or the compression is lossless.
    virtual double bits_per_px() const { return 0; }

    /// Returns the total number of frames as reported by the source, or 0 if unknown.
    virtual std::int64_t length() const { return 0; }
};

struct SourceOptions {
    /// Frame size, or 0 if not specified. Must be specified for raw frames. Cameras are asked to
    /// deliver frames of this size.
    int width_px = 0;
    int height_px = 0;
    /// Frame rate requested from a camera. For other sources, frame timestamps are computed from
    /// this rate, even if a video file contains timestamps.
    std::optional<double> fps;
    std::optional<double> exposure;  ///< exposure of a camera, in the driver's unit
    std::optional<double> gain;      ///< gain of a camera, in the driver's unit
    /// True to flip frames left to right. Frames are flipped before they are cropped to `region`.
    bool flip = false;
    std::optional<Region> region;  ///< part of each frame to keep, or empty for the whole frame
    /// Required size of frames before cropping. Set if a camera file defines the pixel coordinates
    /// of `region`.
    std::optional<std::pair<int, int>> whole_size_px;
    /// Maximum number of pixels in an image. Larger images are rejected with ImageTooLarge before
    /// they are decoded.
    int max_pixels = kMaxFrameSide_px * kMaxFrameSide_px;
    /// Called periodically. If the function returns true, the source stops delivering frames.
    std::function<bool()> stop = [] { return false; };
    /// Called with messages for the user, for example if a camera was unplugged. The source
    /// continues afterwards.
    std::function<void(const std::string&)> notify = [](const std::string&) {};
    /// Called with the path of each image or video before it is opened. May throw Error.
    std::function<void(const std::string&)> before_reading = [](const std::string&) {};
    /// Called for each image that cannot be read. The source continues with the next image.
    std::function<void(const std::string& file, const Error&)> on_unreadable =
        [](const std::string&, const Error&) {};
    /// Opens cameras and video files (video/module.hpp), or throws Error.
    std::function<std::unique_ptr<FrameSource>(const std::string& name, const SourceOptions&)>
        open_live;
};

/// Returns a region of an image. Throws BadArgument if the region extends beyond the image.
GreyImage cropped(const GreyImage& image, const Region& region);

/// Flips and crops a frame according to the options. If the options contain a region, throws
/// BadArgument if the region extends beyond the frame, and Error if the frame size differs from
/// `options.whole_size_px`. The message of the Error contains `name`.
void prepare(const SourceOptions& options, const std::string& name, GreyImage& image);

/// Returns the time of frame `index` in microseconds: index / fps.
std::int64_t time_of(std::int64_t index, double fps);

/// Opens a source that reads raw 8-bit grey frames from standard input. Throws BadArgument if the
/// options do not specify the frame size.
std::unique_ptr<FrameSource> open_raw(const SourceOptions& options);

/// Opens a list of images. `next_path` returns the path of the next image, or an empty optional at
/// the end of the list.
std::unique_ptr<FrameSource> open_images(std::function<std::optional<std::string>()> next_path,
                                         const SourceOptions& options);

}  // namespace dotpose::capture
