/// Poses as fields of output lines, in the units that the user chose.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/sheet_place.hpp"
#include "fields.hpp"

namespace dotpose::cli {

/// The units and frames of poses in the output. World poses are in metres and radians in both.
enum class Units {
    mm,   ///< mm and degrees, y down and angles clockwise as on the paper
    ros,  ///< metres and radians, y up, z out of the paper, counter-clockwise (ROS REP 103)
};

/// A pose in a plane in mm and rad.
struct PlanePose {
    double x_mm = 0;
    double y_mm = 0;
    double theta_rad = 0;
    PoseCovariance covariance{};  ///< of the three, in mm and rad; all 0 if it is not known
};

/// Returns the pose of a fix in the pattern frame. The fix must be ok.
PlanePose pattern_pose(const Fix& fix, double spacing_mm);

/// Returns the same pose with y and angle reversed: up instead of down, or down instead of up.
PlanePose with_other_y(const PlanePose& pose);

/// Names of the fields of a pose, such as x_mm, y_mm, theta_deg and covariance_mm_deg.
struct PoseNames {
    std::string x;
    std::string y;
    std::string angle;
    std::string covariance;
};

/// Returns the names of a pose in the pattern frame, the sheet frame or of the track.
PoseNames pattern_names(Units units);
PoseNames sheet_names(Units units);
PoseNames track_names(Units units);

/// Return the three fields of a pose and the nine of its covariance, row by row; they are empty
/// without a pose, and those of the covariance also if it is not known. The pose is written as it
/// is, in mm and degrees or in metres and radians.
std::vector<Field> pose_fields(const PoseNames& names, Units units,
                               const std::optional<PlanePose>& pose);
std::vector<Field> covariance_fields(const PoseNames& names, Units units,
                                     const std::optional<PlanePose>& pose);

/// Returns the fields x_m, y_m, yaw_rad and covariance_m_rad.
std::vector<Field> world_fields(const std::optional<WorldPlace>& place);

/// Formats a length in metres; `mm` is its value in mm.
std::string metres(double mm);

/// Appends fields to others.
void append(std::vector<Field>& fields, std::vector<Field> more);

}  // namespace dotpose::cli
