// Draws the progress of a calibration: tints the parts of the frame in which no dots have been seen
// yet, and draws gauges beside the frame.
#pragma once

#include <opencv2/core.hpp>

#include "video/screen.hpp"

namespace dotpose::video {

/// Tints the parts of the image in which no dots have been seen, and draws a border if this image
/// was added to the calibration. `frame` is the region of the picture that contains the image.
void draw_coverage(const CalibrationScene& scene, cv::Mat frame);

/// Draws the gauges and, below them, a compass that shows which directions have been covered so
/// far.
void draw_gauges(const CalibrationScene& scene, cv::Mat panel);

}  // namespace dotpose::video
