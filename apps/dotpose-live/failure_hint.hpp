/// Tells, once, what is wrong with the pictures of a camera of which most cannot be located.
#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include "dotpose/image.hpp"
#include "frame_locator.hpp"

namespace dotpose::cli {

class FailureHint {
  public:
    /// After each frame, which `reading` is of. A sentence when most frames of the last second have
    /// failed, and again after most of a second have not; else empty. `options`: as it was located.
    std::string after(const Reading& reading, ImageView image, const Options& options);

  private:
    struct Frame {
        std::int64_t time_us = 0;
        bool has_failed = false;
    };

    std::deque<Frame> last_second_;
    bool is_told_ = false;
};

}  // namespace dotpose::cli
