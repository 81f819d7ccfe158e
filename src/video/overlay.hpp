// Overlay: draws what `locate` saw over a frame, with captions and the path beside it.
#pragma once

#include <opencv2/core.hpp>

#include "video/screen.hpp"

namespace dotpose::video {

/// Always of the same size for frames of the same size; width and height are even, as encoders want
/// them.
cv::Mat overlay(const Scene& scene);

}  // namespace dotpose::video
