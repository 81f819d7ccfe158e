// Determines whether the image of a page was taken with a flatbed scanner or a camera.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/print_fit.hpp"
#include "dotpose/tools/check_print.hpp"

namespace dotpose::calibrate {

/// Returns the perspective and the lens distortion if they show that the image is a photo. Returns
/// an empty optional if a scanner can explain the positions of the dots.
std::optional<CameraSigns> signs_of_camera(const std::vector<Match>& matches,
                                           const Eigen::Vector2d& middle_px);

/// Returns the ratio of the scales along the two axes of a page, computed from a photo. The pixels
/// are assumed to be square. `fit` must be a fit of ViewModel::camera whose `lens_centre` is the
/// middle of the image. Returns an empty optional if the ratio is too uncertain.
std::optional<ScaleRatio> scale_ratio_of(const PlaneFit& fit, double longer_side_px);

}  // namespace dotpose::calibrate
