/// Explains why most frames from a camera or video cannot be located.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "dotpose/image.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "reading.hpp"

namespace dotpose::cli {

class FailureHint {
  public:
    /// Must be called after each frame. `options` are the options used to locate the frame.
    /// `bits_per_px` is the bit rate of the source (capture/frame_source.hpp). Returns a hint for
    /// the user if this frame failed, and if more than half of the frames in the last second, but
    /// at least three, failed. Returns an empty string otherwise, and during the first second. The
    /// hint is not repeated until the fraction of failed frames in the last second has dropped to
    /// one half or less.
    std::string after(const Reading& reading, ImageView image, const DeviceOptions& options,
                      double bits_per_px);

    /// Returns a hint for the user if more than half of the frames in the run failed, and an empty
    /// string otherwise.
    std::string at_end() const;

  private:
    struct Frame {
        std::int64_t time_us = 0;
        bool has_failed = false;
    };
    /// Number of frames that failed with one status, and a copy of one of these frames.
    struct Failures {
        std::int64_t count = 0;
        Record record;
        GreyImage image;
    };

    void remember(const Record& record, ImageView image, const DeviceOptions& options,
                  double bits_per_px);

    std::deque<Frame> last_second_;
    bool is_reported_ = false;
    std::int64_t frames_ = 0;
    std::int64_t failed_ = 0;
    std::map<Status, Failures> failures_;
    DeviceOptions options_;  ///< locator options for the newest failed frame
    double bits_per_px_ = 0;
};

}  // namespace dotpose::cli
