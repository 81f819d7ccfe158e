/// Explains why most frames of a camera or video cannot be located.
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
    /// Takes the result of the attempt to locate a frame with `options`. Returns a sentence for the
    /// user if this frame failed, and more than half and at least three of the frames of the last
    /// second failed. Otherwise returns an empty string. The sentence is returned again only after
    /// the fraction of failed frames in a second has dropped to a half or less. `bits_per_px` is
    /// the bit rate of the source (capture/frame_source.hpp).
    std::string after(const Reading& reading, ImageView image, const DeviceOptions& options,
                      double bits_per_px);

    /// Returns a sentence if more than half of the frames of the run failed, otherwise an empty
    /// string.
    std::string at_end() const;

  private:
    struct Frame {
        std::int64_t time_us = 0;
        bool has_failed = false;
    };
    /// The frames that failed with one status: their number, and a copy of one frame.
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
    DeviceOptions options_;  ///< options of the newest frame that failed
    double bits_per_px_ = 0;
};

}  // namespace dotpose::cli
