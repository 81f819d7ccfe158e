/// The text that `dotpose calibrate` prints.
#pragma once

#include <string>

#include "dotpose/tools/calibrate.hpp"

namespace dotpose::cli {

std::string lens_report(const LensCalibration& calibration);
std::string spin_report(const SpinCalibration& calibration);
std::string drive_report(const DriveCalibration& calibration);
std::string stitching_report(const Stitching& stitching);

}  // namespace dotpose::cli
