/// Progress of the calibration of a lens, for the window, the terminal and the page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/tools/calibration_coverage.hpp"
#include "video/screen.hpp"

namespace dotpose::cli {

/// Tilt of the camera in one frame, along the u and v axes of the image. Each value is the relative
/// change of the image scale over a distance along the axis. The distance is half the image
/// diagonal.
struct FrameTilt {
    double u = 0;
    double v = 0;
};

struct CalibrationStatus {
    explicit CalibrationStatus(const CalibrationCoverage& shown) : coverage(shown) {}

    CalibrationCoverage coverage;
    std::vector<CalibrationNeed> needs;  ///< unmet requirements, most urgent first
    /// Standard deviation of the undistorted position of the farthest image corner, from the newest
    /// finished calibration. Empty if no calibration has finished or if the newest one failed.
    std::optional<double> corner_sigma_px;
    std::optional<double> theta_rad;  ///< direction of the newest frame, if it was located
    std::vector<FrameTilt> tilts;     ///< tilts of the frames that were taken
    std::string now;                  ///< result of the newest frame
    std::string remark;               ///< advice after the newest calibration; may be empty
    bool is_taken = false;            ///< true if the newest frame was accepted for calibration
};

/// Returns the progress towards each goal of the calibration.
std::vector<video::Gauge> gauges_of(const CalibrationStatus& status);

/// Returns the number of frames that were taken, as text.
std::string taken_text(const CalibrationStatus& status);

/// Returns the most urgent advice as text for the user.
std::string next_text(const CalibrationStatus& status);

}  // namespace dotpose::cli
