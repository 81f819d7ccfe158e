#include "sheet_changes.hpp"

#include <numbers>

namespace dotpose::cli {

SheetEntry placed(SheetEntry entry, const std::optional<PagePose>& pose) {
    entry.world.reset();
    if (pose) {
        entry.world = {pose->x_mm / kMmPerM, pose->y_mm / kMmPerM,
                       pose->yaw_deg * std::numbers::pi / 180};
    }
    return entry;
}

std::optional<PagePose> page_pose(const SheetEntry& entry) {
    if (!entry.world) return std::nullopt;
    return PagePose{kMmPerM * entry.world->x_m, kMmPerM * entry.world->y_m,
                    entry.world->yaw_rad * 180 / std::numbers::pi};
}

SheetEntry scaled(SheetEntry entry, const MeasuredLength& length) {
    const double scale = length.measured_mm / length.nominal_mm;
    if (length.along != "y") entry.print_scale_x = scale;
    if (length.along != "x") entry.print_scale_y = scale;
    return entry;
}

SheetEntry with_offset(SheetEntry entry, double right_mm, double below_mm) {
    entry.sheet.origin_x_mm = right_mm;
    entry.sheet.origin_y_mm = below_mm;
    return entry;
}

}  // namespace dotpose::cli
