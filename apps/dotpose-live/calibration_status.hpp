/// Progress of a lens calibration, as displayed in the window, in the terminal and on the web page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/tools/calibration_coverage.hpp"
#include "video/screen.hpp"

namespace dotpose::cli {

/// Tilt of the camera in one frame, along the u and v axes of the image. Each component is the
/// relative change of the image scale along its axis, over a distance of half the image diagonal.
struct FrameTilt {
    double u = 0;
    double v = 0;
};

struct CalibrationStatus {
    explicit CalibrationStatus(const CalibrationCoverage& shown) : coverage(shown) {}

    CalibrationCoverage coverage;
    std::vector<CalibrationNeed> needs;  ///< unmet requirements, most urgent first
    /// Standard deviation of the undistorted position of the farthest image corner, according to
    /// the last finished calibration. nullopt if no calibration has finished or the last one
    /// failed.
    std::optional<double> corner_sigma_px;
    std::optional<double> theta_rad;  ///< theta of the newest frame, or nullopt if it was refused
    std::vector<FrameTilt> tilts;     ///< tilts of the collected frames
    std::string now;                  ///< message about the newest frame
    std::string remark;               ///< advice after the last calibration, or empty
    bool is_taken = false;            ///< true if the newest frame was accepted for calibration
};

/// Returns the progress towards each goal of the calibration.
std::vector<video::Gauge> gauges_of(const CalibrationStatus& status);

/// Returns the number of collected frames as text.
std::string taken_text(const CalibrationStatus& status);

/// Returns the most urgent advice for the user.
std::string next_text(const CalibrationStatus& status);

}  // namespace dotpose::cli
