// Print view: whether an image of a page was taken on a flatbed or by a camera.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/print_fit.hpp"
#include "dotpose/tools/check_print.hpp"

namespace dotpose::calibrate {

/// Returns perspective and lens if they are larger than on any scanner; none if the page lies as on
/// a scanner.
std::optional<CameraSigns> signs_of_camera(const std::vector<Match>& matches,
                                           const Eigen::Vector2d& middle_px);

/// Returns the ratio of the scales of a page in a photo with square pixels, from a fit of
/// ViewModel::camera whose `lens_centre` is the middle of the image, with its longer side
/// `longer_side_px`. None if it is too uncertain.
std::optional<ScaleRatio> scale_ratio_of(const PlaneFit& fit, double longer_side_px);

}  // namespace dotpose::calibrate
