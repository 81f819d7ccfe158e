// Concatenates several frame sources into one.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "capture/frame_source.hpp"

namespace dotpose::capture {

/// Concatenates sources. Frame numbers and times continue from one source to the next.
class SourceList : public FrameSource {
  public:
    /// `next_name` returns the name of the next source (source_kind.hpp), or an empty optional
    /// after the last source.
    SourceList(std::function<std::optional<std::string>()> next_name, SourceOptions options);

    /// Opens the first source, so that its rate is available before the first frame. This call is
    /// optional, because `next` also opens the source. Returns false if there are no names. Throws
    /// Error if the source does not exist or cannot be read, and BadArgument if the size of raw
    /// frames is not specified.
    bool open();

    /// Gets the next frame from the concatenated sources. Throws Error if a source fails. In this
    /// case, the next call continues with the source after the failed one. Throws BadArgument if
    /// the region extends beyond the frame.
    bool next(Frame& frame) override;
    std::int64_t dropped() const override;
    double rate() const override { return source_ ? source_->rate() : 0; }
    double bits_per_px() const override { return bits_per_px_; }

    /// Returns the number of frames in the open source, or 0 if unknown.
    std::int64_t length() const override { return source_ ? source_->length() : 0; }

    /// Returns the name of the newest frame: the path of an image, or SOURCE#N for frame N (counted
    /// from 0) of any other source.
    std::string name_of_frame() const;

  private:
    std::optional<std::string> take_name();
    std::optional<std::string> next_image();
    void close();
    void put_in_order(Frame& frame);

    std::function<std::optional<std::string>()> next_name_;
    SourceOptions options_;
    /// Name of the source to open next, if `next_image` has already taken it from the list.
    std::optional<std::string> pending_name_;
    std::vector<std::string> images_;  ///< images of the current folder or glob, or a single image
    std::size_t next_image_ = 0;
    std::unique_ptr<FrameSource> source_;
    std::string name_;
    Frame newest_;            ///< newest frame without its image; `index` is relative to its source
    double bits_per_px_ = 0;  ///< `bits_per_px` of the latest source that returned a frame
    std::int64_t dropped_before_ = 0;
    std::int64_t next_index_ = 0;
    std::int64_t next_time_us_ = 0;
    std::int64_t first_index_ = 0;  ///< index of the first frame of the current source
    std::int64_t offset_us_ = 0;    ///< offset added to the frame times of the current source
    bool has_first_ = false;        ///< true if the current source has returned a frame
    bool is_first_source_ = true;
};

}  // namespace dotpose::capture
