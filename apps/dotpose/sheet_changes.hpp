/// Changes of an entry of a sheet file, in the units of the user: mm and degrees. `dotpose sheets`
/// and the page of `dotpose watch --web` use them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/sheet_file.hpp"

namespace dotpose::cli {

inline constexpr double kMmPerM = 1000;

/// Pose of the top left corner of a page in the world, with y up.
struct PagePose {
    double x_mm = 0;
    double y_mm = 0;
    double yaw_deg = 0;  ///< direction of the upper edge, counter-clockwise
};

/// Returns the entry with a pose in the world, or without one.
SheetEntry placed(SheetEntry entry, const std::optional<PagePose>& pose);

/// Returns the pose of an entry in the world, or none if it is not known.
std::optional<PagePose> page_pose(const SheetEntry& entry);

/// Names of directions in which a length is measured on a page.
inline const std::vector<std::string> kDirections = {"x", "y", "both"};

/// A length that was measured on a printed page.
struct MeasuredLength {
    double measured_mm = 0;
    double nominal_mm = 0;       ///< the length that it should be
    std::string along = "both";  ///< one of `kDirections`
};

/// Returns the entry with the print scale of a measured length.
SheetEntry scaled(SheetEntry entry, const MeasuredLength& length);

/// Returns the entry with another distance of the first intersection from the top left corner of
/// the page, which moves all dots.
SheetEntry with_offset(SheetEntry entry, double right_mm, double below_mm);

}  // namespace dotpose::cli
