/// Poses as fields of output lines, in the units selected by the user.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/sheet_place.hpp"
#include "fields.hpp"

namespace dotpose::cli {

/// Units and axes of poses in the output. World poses are always in metres and radians.
enum class Units {
    mm,   ///< mm and degrees, y down, angles clockwise, as seen on the paper
    ros,  ///< metres and radians, y up, z out of the paper, angles counter-clockwise (ROS REP 103)
};

/// A pose in a plane, in mm and rad.
struct PlanePose {
    double x_mm = 0;
    double y_mm = 0;
    double theta_rad = 0;
    /// Covariance of x, y and theta, in mm and rad, or all zeros if unknown.
    PoseCovariance covariance{};
};

/// Returns the pose of a fix in the pattern frame. The status of the fix must be `ok`.
PlanePose pattern_pose(const Fix& fix, double spacing_mm);

/// Converts a pose between y down and y up, by negating y and the angle.
PlanePose with_other_y(const PlanePose& pose);

/// Field names of a pose and its covariance, such as x_mm, y_mm, theta_deg and covariance_mm_deg.
struct PoseNames {
    std::string x;
    std::string y;
    std::string angle;
    std::string covariance;
};

/// Return the field names of a pose in the pattern frame, of a pose in the sheet frame, and of a
/// track.
PoseNames pattern_names(Units units);
PoseNames sheet_names(Units units);
PoseNames track_names(Units units);

/// Return the three fields of a pose, or the nine fields of its covariance in row-major order. All
/// fields are empty if there is no pose, and the covariance fields are also empty if the covariance
/// is unknown. The values are converted to the units selected by `units`, but the axes are not
/// changed.
std::vector<Field> pose_fields(const PoseNames& names, Units units,
                               const std::optional<PlanePose>& pose);
std::vector<Field> covariance_fields(const PoseNames& names, Units units,
                                     const std::optional<PlanePose>& pose);

/// Returns the fields x_m, y_m, yaw_rad and covariance_m_rad.
std::vector<Field> world_fields(const std::optional<WorldPlace>& place);

/// Formats a length in metres.
std::string metres(double mm);

void append(std::vector<Field>& fields, std::vector<Field> more);

}  // namespace dotpose::cli
