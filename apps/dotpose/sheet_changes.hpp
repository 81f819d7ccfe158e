/// Changes entries of a sheet file. Lengths and angles are in mm and degrees, the units of the user
/// interface. Used by `dotpose sheets` and by the web page of `dotpose watch --web`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/sheet_file.hpp"

namespace dotpose::cli {

inline constexpr double kMmPerM = 1000;

/// World pose of the top left corner of a page, with y up.
struct PagePose {
    double x_mm = 0;
    double y_mm = 0;
    double yaw_deg = 0;  ///< direction of the top edge, counter-clockwise from the x axis
};

/// Returns the entry with the given world pose, or without a world pose if `pose` is none.
SheetEntry placed(SheetEntry entry, const std::optional<PagePose>& pose);

/// Returns the world pose of an entry, or none if it is unknown.
std::optional<PagePose> page_pose(const SheetEntry& entry);

/// Names of the directions in which a length on a page can be measured, as used in options.
inline const std::vector<std::string> kDirections = {"x", "y", "both"};

/// A length measured on a printed page.
struct MeasuredLength {
    double measured_mm = 0;
    double nominal_mm = 0;       ///< length with a print scale of 1
    std::string along = "both";  ///< one of `kDirections`
};

/// Returns the entry with the print scale computed from a measured length.
SheetEntry scaled(SheetEntry entry, const MeasuredLength& length);

/// Returns a copy of `entry` in which all dots are shifted by the same amount. The shift moves the
/// first intersection to the point that is `right_mm` to the right of the top left corner of the
/// page and `below_mm` below it.
SheetEntry with_offset(SheetEntry entry, double right_mm, double below_mm);

}  // namespace dotpose::cli
