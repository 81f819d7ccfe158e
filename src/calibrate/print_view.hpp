// How an image of a page was taken: on a flatbed, or by a camera.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/print_fit.hpp"
#include "dotpose/check_print.hpp"

namespace dotpose::calibrate {

/// What only a camera does to a page; nothing if it lies as on a scanner.
std::optional<CameraSigns> signs_of_camera(const std::vector<Match>& matches,
                                           const Eigen::Vector2d& middle_px);

}  // namespace dotpose::calibrate
