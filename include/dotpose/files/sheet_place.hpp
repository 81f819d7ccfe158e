/// Places: where a fix lies on a page of a sheet file, and in the world that the page lies in, with
/// the full covariance of the pose.
///
///     const std::vector<SheetEntry> sheets = read_sheets("sheets.json");
///     if (const auto place = find_sheet(sheets, Profile::anoto, fix)) {
///         use(place->x_mm, place->y_mm, place->theta_rad, place->covariance);
///         if (const auto world = world_place(*place)) use(world->x_m, world->y_m, world->yaw_rad);
///     }
///
/// Frames: *sheet*, mm from the top left corner of the page, x right, y DOWN, angles clockwise;
/// *world*, metres, right-handed, z out of the paper, y up, angles counter-clockwise (ROS REP-103).
#pragma once

#include <array>
#include <optional>
#include <span>

#include "dotpose/code.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/fix.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Covariance of a pose, (x, y, angle): in the squares and products of the units of that pose.
using PoseCovariance = std::array<std::array<float, 3>, 3>;

/// Where a fix lies on a page.
struct SheetPlace {
    const SheetEntry* entry = nullptr;  ///< one of those that were searched
    double x_mm = 0;                    ///< sheet frame, print scale applied
    double y_mm = 0;
    double theta_rad = 0;  ///< of the image x axis, from the sheet's +x towards +y, in (-pi, pi]
    /// Covariance of (x_mm, y_mm, theta_rad), from that of the fix. All 0 if the fix has none.
    PoseCovariance covariance{};
};

/// The sheet that shows what was located, with this profile, at `fix`: the one whose region holds
/// the place, otherwise one on whose margins it lies. None if the fix is not ok or lies elsewhere.
std::optional<SheetPlace> find_sheet(std::span<const SheetEntry> sheets, Profile profile,
                                     const Fix& fix);

/// Where a fix lies in the world.
struct WorldPlace {
    double x_m = 0;
    double y_m = 0;
    double yaw_rad = 0;  ///< of the image x axis, counter-clockwise from the world's, in (-pi, pi]
    /// Covariance of (x_m, y_m, yaw_rad), from that of the fix; the page's pose counts as exact.
    PoseCovariance covariance{};
};

/// Converts a place on a sheet to the world. None if the pose of the sheet is not known.
std::optional<WorldPlace> world_place(const SheetPlace& place);

/// The covariance of a pose on a sheet as that of the same pose in the world, where the page's
/// upper edge runs in the direction of `sheet_yaw_rad`: turned by it, with y and the angle the
/// other way around. The unit of length stays.
PoseCovariance world_covariance(const PoseCovariance& on_sheet, double sheet_yaw_rad);

}  // namespace dotpose

#pragma GCC visibility pop
