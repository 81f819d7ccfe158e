// Determines whether the image of a page was taken with a flatbed scanner or a camera.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/print_fit.hpp"
#include "dotpose/tools/check_print.hpp"

namespace dotpose::calibrate {

/// Returns the perspective and lens distortion of an image if they are so strong that the image
/// must be a photo rather than a scan. Returns nullopt if the image may be a scan.
std::optional<CameraSigns> signs_of_camera(const std::vector<Match>& matches,
                                           const Eigen::Vector2d& middle_px);

/// Returns the ratio of the scales along the two axes of a page, computed from a photo with square
/// pixels. `fit` must use ViewModel::camera, and its `lens_centre` must be the middle of the image.
/// Returns nullopt if the ratio is too uncertain.
std::optional<ScaleRatio> scale_ratio_of(const PlaneFit& fit, double longer_side_px);

}  // namespace dotpose::calibrate
