// Sources of frames: images, folders of images, raw grey frames in a pipe, and, through the layer
// `video`, cameras and video files.
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
    std::int64_t time_us = 0;  ///< time of the frame on the source's clock; increases
    std::int64_t index = 0;    ///< number of the frame from 0; dropped frames are counted too
    std::string file;          ///< path of an image; empty for frames of other sources
    bool is_live = false;      ///< whether `time_us` is on this computer's monotonic clock
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

    /// Gets the next frame, or the newest one of a camera. Returns false at the end or when
    /// `SourceOptions::stop` returns true. Throws Error if the source fails, after all
    /// frames before the failure have been returned.
    virtual bool next(Frame& frame) = 0;

    /// Number of frames that were captured but not returned by `next`.
    virtual std::int64_t dropped() const { return 0; }

    /// Frame rate that the source reports, in frames per second; 0 if not known.
    virtual double rate() const { return 0; }

    /// Mean number of bits per pixel of the compressed frames so far; 0 if not known or not lossy.
    virtual double bits_per_px() const { return 0; }

    /// Number of all frames that the source reports; 0 if not known.
    virtual std::int64_t length() const { return 0; }
};

struct SourceOptions {
    /// Size of raw frames (required), or size requested from a camera; 0 if not given.
    int width_px = 0;
    int height_px = 0;
    /// Frame rate requested from a camera. For other sources, the frame rate from which times are
    /// computed; it overrides the times in a video file.
    std::optional<double> fps;
    std::optional<double> exposure;  ///< in the driver's own unit
    std::optional<double> gain;      ///< in the driver's own unit
    bool flip = false;               ///< whether frames are flipped, left to right, before `region`
    std::optional<Region> region;    ///< the part of each frame that is kept
    /// Required size of whole frames if `region` refers to the image of a camera file.
    std::optional<std::pair<int, int>> whole_size_px;
    /// Maximum number of pixels; larger images throw ImageTooLarge before they are decoded.
    int max_pixels = kMaxFrameSide_px * kMaxFrameSide_px;
    /// Called from time to time; when it returns true, the source ends.
    std::function<bool()> stop = [] { return false; };
    /// Called with messages for the user, for example that a camera was unplugged; the source
    /// continues.
    std::function<void(const std::string&)> tell = [](const std::string&) {};
    /// Called with the path of each image or video before it is opened; may throw Error.
    std::function<void(const std::string&)> before_reading = [](const std::string&) {};
    /// Called for an image that cannot be read; the source continues with the next image.
    std::function<void(const std::string& file, const Error&)> on_unreadable =
        [](const std::string&, const Error&) {};
    /// Opens cameras and video files (video/module.hpp), or throws Error.
    std::function<std::unique_ptr<FrameSource>(const std::string& name, const SourceOptions&)>
        open_live;
};

/// Returns a part of an image. Throws BadArgument if it extends beyond the image.
GreyImage cropped(const GreyImage& image, const Region& region);

/// Flips and crops a frame as the options say. Throws BadArgument if the region extends beyond the
/// frame, and Error with the name of the frame if the frame does not have the size `whole_size_px`.
void prepare(const SourceOptions& options, const std::string& name, GreyImage& image);

/// Returns the time of a frame in microseconds from its number and the frame rate.
std::int64_t time_of(std::int64_t index, double fps);

/// Returns a source of raw 8-bit grey frames on standard input. Throws BadArgument if their size is
/// not given.
std::unique_ptr<FrameSource> open_raw(const SourceOptions& options);

/// Returns a source of the images at the paths that `next_path` returns, until it returns none.
std::unique_ptr<FrameSource> open_images(std::function<std::optional<std::string>()> next_path,
                                         const SourceOptions& options);

}  // namespace dotpose::capture
