/// Places: the pose of a fix relative to a page of a sheet file, and relative to the world. Both
/// poses have a full covariance.
///
///     const std::vector<SheetEntry> sheets = read_sheets("sheets.json");
///     if (const auto place = find_sheet(sheets, CodeVariant::anoto, fix)) {
///         use(place->x_mm, place->y_mm, place->theta_rad, place->covariance);
///         if (const auto world = world_place(*place)) use(world->x_m, world->y_m, world->yaw_rad);
///     }
///
/// Coordinate frames:
/// - *sheet*: mm from the top left corner of the page, x right, y DOWN, angles clockwise.
/// - *world*: metres, right-handed, z out of the paper, y up, angles counter-clockwise (ROS
///   REP-103).
#pragma once

#include <array>
#include <optional>
#include <span>

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/fix.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Covariance of a pose (x, y, angle). The unit of each element is the product of the units of its
/// two coordinates.
using PoseCovariance = std::array<std::array<float, 3>, 3>;

/// Place of a fix on a page of a sheet file.
struct SheetPlace {
    const SheetEntry* entry = nullptr;  ///< entry of the page, in the span passed to `find_sheet`
    /// Position in the sheet frame, corrected for the print scale.
    double x_mm = 0;
    double y_mm = 0;
    /// Angle of the image x axis, from the sheet's +x towards +y, in (-pi, pi].
    double theta_rad = 0;
    /// Covariance of (x_mm, y_mm, theta_rad), from the covariance of the fix. All 0 if the fix has
    /// no covariance.
    PoseCovariance covariance{};
};

/// Returns the place of `fix` on the sheet that contains the fix. `code` is the code variant in
/// which the fix was read. Sheets in other code variants are ignored. A sheet whose region contains
/// the fix takes precedence over a sheet that contains the fix only in its margins. Returns nullopt
/// if the fix is not ok, or if no sheet contains the fix.
std::optional<SheetPlace> find_sheet(std::span<const SheetEntry> sheets, CodeVariant code,
                                     const Fix& fix);

/// Place of a fix in the world.
struct WorldPlace {
    double x_m = 0;
    double y_m = 0;
    /// Angle of the image x axis, counter-clockwise from the x axis of the world, in (-pi, pi].
    double yaw_rad = 0;
    /// Covariance of (x_m, y_m, yaw_rad), from the covariance of the fix. The pose of the page is
    /// assumed to be exact.
    PoseCovariance covariance{};
};

/// Converts a place on a sheet to world coordinates. Returns nullopt if the world pose of the sheet
/// is not known.
std::optional<WorldPlace> world_place(const SheetPlace& place);

/// Converts the covariance of a pose from the sheet frame to the world frame, by rotating it and
/// negating y and the angle. `sheet_yaw_rad` is the direction of the upper edge of the page in the
/// world. Lengths keep their unit.
PoseCovariance world_covariance(const PoseCovariance& on_sheet, double sheet_yaw_rad);

}  // namespace dotpose

DOTPOSE_END_EXPORT
