// Draws the progress of a calibration: the covered parts of the image over the frame, and gauges
// beside it.
#pragma once

#include <opencv2/core.hpp>

#include "video/screen.hpp"

namespace dotpose::video {

/// Tints the parts of the image in which no dots were seen. `frame` is the whole frame.
void draw_coverage(const CalibrationScene& scene, cv::Mat frame);

/// Draws the gauges and, below them, the directions in which frames were taken.
void draw_gauges(const CalibrationScene& scene, cv::Mat panel);

}  // namespace dotpose::video
