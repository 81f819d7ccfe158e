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
    GreyImage image;           ///< empty if the camera does not deliver any frame at the moment
    std::int64_t time_us = 0;  ///< time of the frame on the source's clock; increases
    std::int64_t index = 0;    ///< number of the frame from 0; dropped frames are counted too
    std::string file;          ///< path of an image; empty for frames of other sources
    bool is_live = false;      ///< whether that clock is this computer's monotonic one
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

    /// Number of frames that were taken but not returned by `next`.
    virtual std::int64_t dropped() const { return 0; }

    /// Frames per second as the source states it, or 0 if it is not known.
    virtual double rate() const { return 0; }

    /// Mean number of bits per pixel that lossy compression left of the frames so far; 0 if it is
    /// not known or not lossy.
    virtual double bits_per_px() const { return 0; }

    /// Number of all frames as the source states it, or 0 if it is not known.
    virtual std::int64_t length() const { return 0; }
};

struct SourceOptions {
    /// Size of raw frames, for which it is required, or the size to ask a camera for. 0: not given.
    int width_px = 0;
    int height_px = 0;
    /// Frames per second to ask a camera for. Of other sources, the frame rate that gives frames
    /// their times; it replaces the times in a video file.
    std::optional<double> fps;
    std::optional<double> exposure;  ///< in the driver's own unit
    std::optional<double> gain;      ///< in the driver's own unit
    bool flip = false;               ///< whether frames are flipped, left to right, before `region`
    std::optional<Region> region;    ///< the part of each frame that is kept
    /// Size that whole frames must have where `region` is a part of a camera file's image.
    std::optional<std::pair<int, int>> whole_size_px;
    /// Images with more pixels are not decoded: ImageTooLarge.
    int max_pixels = kMaxFrameSide_px * kMaxFrameSide_px;
    /// Called from time to time; when it returns true, the source ends.
    std::function<bool()> stop = [] { return false; };
    /// Called with messages for the user while the source goes on, for example that a camera was
    /// unplugged.
    std::function<void(const std::string&)> tell = [](const std::string&) {};
    /// Called with the path of each image or video before it is opened; may throw Error.
    std::function<void(const std::string&)> before_reading = [](const std::string&) {};
    /// Called for an image that cannot be read; the source goes on with the next one.
    std::function<void(const std::string& file, const Error&)> on_unreadable =
        [](const std::string&, const Error&) {};
    /// Opens cameras and video files (video/module.hpp), or throws Error.
    std::function<std::unique_ptr<FrameSource>(const std::string& name, const SourceOptions&)>
        open_live;
};

/// Returns a part of an image. Throws BadArgument if it extends beyond the image.
GreyImage cropped(const GreyImage& image, const Region& region);

/// Flips and crops a frame as the options say. Throws BadArgument if the region extends beyond the
/// frame, Error with the name of the frame if it does not have its whole size.
void prepare(const SourceOptions& options, const std::string& name, GreyImage& image);

/// Returns the time of a frame in microseconds from its number and the frame rate.
std::int64_t time_of(std::int64_t index, double fps);

/// Raw 8-bit grey frames on standard input. Throws BadArgument if their size is not given.
std::unique_ptr<FrameSource> open_raw(const SourceOptions& options);

/// The images whose paths `next_path` returns, up to none.
std::unique_ptr<FrameSource> open_images(std::function<std::optional<std::string>()> next_path,
                                         const SourceOptions& options);

}  // namespace dotpose::capture
