// Reads any number of sources of frames one after the other, as if they were one.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "capture/frame_source.hpp"

namespace dotpose::capture {

/// Numbers and times of the frames go on from one source to the next.
class SourceList : public FrameSource {
  public:
    /// `next_name` returns the name of the next source (source_kind.hpp), or none after the last.
    SourceList(std::function<std::optional<std::string>()> next_name, SourceOptions options);

    /// Opens the first source, whose rate is then known; otherwise `next` does it. Throws Error if
    /// there is no such source or it cannot be read, and BadArgument if the size of raw frames is
    /// not given. Returns false if there are no names.
    bool open();

    /// As of each source. If one fails, it throws Error, and the call after that goes on with the
    /// next source. Throws BadArgument if the region extends beyond the frame.
    bool next(Frame& frame) override;
    std::int64_t dropped() const override;
    double rate() const override { return source_ ? source_->rate() : 0; }
    double bits_per_px() const override { return bits_per_px_; }

    /// Of the source that is open.
    std::int64_t length() const override { return source_ ? source_->length() : 0; }

    /// Returns the name of the frame that `next` gave last: the path of an image; of other
    /// sources SOURCE#N, where N is the number of the frame in the source, from 0.
    std::string name_of_frame() const;

  private:
    std::optional<std::string> take_name();
    std::optional<std::string> next_image();
    void close();
    void put_in_order(Frame& frame);

    std::function<std::optional<std::string>()> next_name_;
    SourceOptions options_;
    std::optional<std::string> pending_name_;  ///< of the source after a series of images
    std::vector<std::string> images_;          ///< of the newest folder or glob, or one image
    std::size_t next_image_ = 0;
    std::unique_ptr<FrameSource> source_;
    std::string name_;        ///< of the source that is open
    Frame newest_;            ///< without its image; as its source numbers it
    double bits_per_px_ = 0;  ///< of the newest source that has given a frame
    std::int64_t dropped_before_ = 0;
    std::int64_t next_index_ = 0;
    std::int64_t next_time_us_ = 0;
    std::int64_t first_index_ = 0;  ///< of the source that is open
    std::int64_t offset_us_ = 0;    ///< from the clock of this source to that of the list
    bool has_first_ = false;        ///< whether this source has given a frame
    bool is_first_source_ = true;
};

}  // namespace dotpose::capture
