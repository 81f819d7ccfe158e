/// Text reports of `dotpose calibrate`.
#pragma once

#include <string>

#include "dotpose/tools/calibrate.hpp"

namespace dotpose::cli {

/// How the spacing of a calibration was determined.
enum class SpacingSource { assumed, option, sheets };

std::string lens_report(const LensCalibration& calibration, SpacingSource source);
/// Returns a one-line report for live calibration. It contains the standard deviation of the
/// undistorted position of the farthest image corner.
std::string corner_report(const Camera& camera);
std::string spin_report(const SpinCalibration& calibration);
std::string drive_report(const DriveCalibration& calibration);
std::string pivot_report(const PivotCalibration& calibration);
std::string flat_field_report(const FlatFieldCalibration& calibration);
std::string readout_report(const ReadoutCalibration& calibration);
std::string stitching_report(const Stitching& stitching);

}  // namespace dotpose::cli
