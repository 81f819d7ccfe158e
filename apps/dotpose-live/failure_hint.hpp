/// Explains once why most frames of a camera cannot be located.
#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include "dotpose/image.hpp"
#include "reading.hpp"

namespace dotpose::cli {

class FailureHint {
  public:
    /// Takes the result of a frame, which was located with `options`. Returns a sentence once most
    /// frames of the last second have failed, and again only after most of a second were located in
    /// between; otherwise an empty text.
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
