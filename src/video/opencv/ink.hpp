// Colours and pixel coordinates for drawing the live picture.
#pragma once

#include <cmath>

#include <opencv2/core.hpp>

#include "draw/svg.hpp"

namespace dotpose::video {

// Colours, in BGR order.
inline const cv::Scalar kGood(73, 132, 30);
inline const cv::Scalar kBad(43, 57, 192);
inline const cv::Scalar kDot(0, 143, 255);
inline const cv::Scalar kGrid(255, 121, 41);
inline const cv::Scalar kInk(42, 32, 23);
inline const cv::Scalar kPaper(251, 249, 247);

inline cv::Point pixel(draw::Point at) {
    return {static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y))};
}

}  // namespace dotpose::video
