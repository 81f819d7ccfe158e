/// Changes an entry of a sheet file, with lengths and angles in the units of the user: mm and
/// degrees. Used by `dotpose sheets` and by the page of `dotpose watch --web`.
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
    double yaw_deg = 0;  ///< direction of the upper edge, counter-clockwise from x
};

/// Returns the entry with this pose in the world. If `pose` is none, the entry has no pose in the
/// world.
SheetEntry placed(SheetEntry entry, const std::optional<PagePose>& pose);

/// Returns the pose of an entry in the world, or none if it is not known.
std::optional<PagePose> page_pose(const SheetEntry& entry);

/// Names of the directions in which a length on a page can be measured.
inline const std::vector<std::string> kDirections = {"x", "y", "both"};

/// A length that was measured on a printed page.
struct MeasuredLength {
    double measured_mm = 0;
    double nominal_mm = 0;       ///< intended length
    std::string along = "both";  ///< one of `kDirections`
};

/// Returns the entry with the print scale that follows from a measured length.
SheetEntry scaled(SheetEntry entry, const MeasuredLength& length);

/// Returns the entry with all dots shifted so that the first intersection is at (`right_mm`,
/// `below_mm`) from the top left corner of the page.
SheetEntry with_offset(SheetEntry entry, double right_mm, double below_mm);

}  // namespace dotpose::cli
