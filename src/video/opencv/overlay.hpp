// Draws the results of `locate` over a frame, with captions and the path beside the frame.
#pragma once

#include <opencv2/core.hpp>

#include "video/screen.hpp"

namespace dotpose::video {

/// Draws the picture. Its size depends only on the size of the frame. Width and height are even,
/// because video encoders require this.
cv::Mat overlay(const Scene& scene);

}  // namespace dotpose::video
