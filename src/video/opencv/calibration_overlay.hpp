// Draws what a calibration has seen: over the frame the parts of the image, beside it how far
// everything that is wanted has been reached.
#pragma once

#include <opencv2/core.hpp>

#include "video/screen.hpp"

namespace dotpose::video {

/// Tints the parts of the image that have not shown dots. `frame` is all of the frame.
void draw_coverage(const CalibrationScene& scene, cv::Mat frame);

/// Draws the gauges, and below them the directions in which frames were taken.
void draw_gauges(const CalibrationScene& scene, cv::Mat panel);

}  // namespace dotpose::video
