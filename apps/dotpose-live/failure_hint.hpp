/// Explains why most frames of a camera or a video cannot be located.
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
    /// Takes the result of a frame, which was located with `options`. Returns a sentence once most
    /// frames of the last second have failed, and again only after most of a second were located in
    /// between; otherwise an empty text. `bits_per_px` is that of the source of the frame.
    std::string after(const Reading& reading, ImageView image, const Options& options,
                      double bits_per_px);

    /// Returns a sentence if most frames of the whole run have failed; otherwise an empty text.
    std::string at_end() const;

  private:
    struct Frame {
        std::int64_t time_us = 0;
        bool has_failed = false;
    };
    /// The frames that failed with the same status, and one of them.
    struct Failures {
        std::int64_t count = 0;
        Record record;
        GreyImage image;
    };

    void remember(const Record& record, ImageView image, const Options& options,
                  double bits_per_px);

    std::deque<Frame> last_second_;
    bool is_told_ = false;
    std::int64_t frames_ = 0;
    std::int64_t failed_ = 0;
    std::map<Status, Failures> failures_;
    Options options_;  ///< of the newest frame that failed
    double bits_per_px_ = 0;
};

}  // namespace dotpose::cli
