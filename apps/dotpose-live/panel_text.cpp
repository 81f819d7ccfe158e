#include "panel_text.hpp"

#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/core.h>

#include "dotpose/tools/track_names.hpp"
#include "reading_fields.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

struct Shown {
    std::string frame;  ///< name of the frame of reference
    double x_mm = 0;
    double y_mm = 0;
    double angle_rad = 0;
};

/// Returns the pose to display. This is the pose on the sheet if the sheet is known and the track
/// is not in the world frame, and the pose of the track otherwise. Returns nullopt if the required
/// pose is not available.
std::optional<Shown> shown_pose(const Reading& reading) {
    const std::optional<SheetPlace>& place = reading.record.place;
    const TrackedPose& pose = reading.track.pose;
    const std::string sheet = place ? "sheet " + printable(place->entry->name) : "";
    const bool is_world = reading.plane == Plane::sheet_world;
    if (place && !is_world) {
        return Shown{sheet + " (y down)", place->x_mm, place->y_mm, place->theta_rad};
    }
    if (reading.track.is_lost) return std::nullopt;
    std::string frame = is_world ? "world (y up)" : "pattern (y down)";
    if (place) frame += ", " + sheet;
    return Shown{frame, pose.x_mm(), pose.y_mm(), pose.theta_rad()};
}

}  // namespace

std::vector<std::string> panel_text(const Reading& reading) {
    const Fix& fix = reading.record.fix;
    const bool is_ok = fix.status == Status::ok;
    std::vector<std::string> lines = {
        fmt::format("frame {}   {:.3f} s   {}", reading.index,
                    static_cast<double>(reading.time_us) * 1e-6, is_ok ? name(fix.attempt) : ""),
        is_ok ? fmt::format("{} dots, {} bits wrong, p {:.0e}", fix.dots_used, fix.bit_errors,
                            fix.p_wrong())
              : std::string(name(fix.status)),
        state_name(reading.track) + " " + event_names(reading.track.events),
    };
    const auto shown = shown_pose(reading);
    if (!shown) return lines;
    lines.push_back(shown->frame);
    lines.push_back(fmt::format("x {:.3f}  y {:.3f} mm", shown->x_mm, shown->y_mm));
    std::string motion = fmt::format("{:.2f} deg", shown->angle_rad * 180 / std::numbers::pi);
    if (!reading.track.is_lost) {
        const TrackedPose& pose = reading.track.pose;
        motion += fmt::format("   {:.1f} mm/s", std::hypot(static_cast<double>(pose.vx_mm_s),
                                                           static_cast<double>(pose.vy_mm_s)));
    }
    lines.push_back(motion);
    return lines;
}

}  // namespace dotpose::cli
