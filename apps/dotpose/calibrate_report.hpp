/// The text that `dotpose calibrate` prints.
#pragma once

#include <string>

#include "dotpose/tools/calibrate.hpp"

namespace dotpose::cli {

/// Where the spacing of a calibration comes from.
enum class SpacingSource { assumed, option, sheets };

std::string lens_report(const LensCalibration& calibration, SpacingSource source);
/// How well the corner of the image is known after a live calibration.
std::string corner_report(const Camera& camera);
std::string spin_report(const SpinCalibration& calibration);
std::string drive_report(const DriveCalibration& calibration);
std::string stitching_report(const Stitching& stitching);

}  // namespace dotpose::cli
