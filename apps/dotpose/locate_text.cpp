// Formats the lines of `locate --format text`.
#include <cmath>
#include <string>

#include <fmt/core.h>

#include "dotpose/files/degrees.hpp"
#include "locate_record.hpp"
#include "space_fields.hpp"
#include "terminal_text.hpp"
#include "tip_fields.hpp"

namespace dotpose::cli {
namespace {

/// Formats a value and its standard deviation. The standard deviation is omitted if `sigma` is 0,
/// which means unknown.
std::string with_deviation(double value, double sigma, int decimals, const std::string& unit) {
    const std::string deviation = sigma > 0 ? fmt::format(" ± {:.2g}", sigma) : std::string();
    return fmt::format("{}{} {}", decimal(value, decimals), deviation, unit);
}

/// Formats x, y and the angle of `pose`, with their standard deviations. `pose` is in mm and rad.
std::string pose_text(PlanePose pose, Units units) {
    const bool is_ros = units == Units::ros;
    if (is_ros) pose = with_other_y(pose);
    const auto sigma = [&pose](std::size_t i) { return std::sqrt(double{pose.covariance[i][i]}); };
    const auto length = [&](double mm, double sigma_mm) {
        return is_ros ? with_deviation(mm / 1000, sigma_mm / 1000, 7, "m")
                      : with_deviation(mm, sigma_mm, 4, "mm");
    };
    const std::string angle =
        is_ros ? with_deviation(pose.theta_rad, sigma(2), 5, "rad")
               : with_deviation(pose.theta_rad * kDegrees, sigma(2) * kDegrees, 3, "deg");
    return fmt::format("x {}, y {}, angle {}", length(pose.x_mm, sigma(0)),
                       length(pose.y_mm, sigma(1)), angle);
}

std::string place_text(const Record& record, Units units) {
    if (const auto& place = record.place) {
        std::string text = fmt::format(
            "sheet {}, {}", place->entry->name,
            pose_text({place->x_mm, place->y_mm, place->theta_rad, place->covariance}, units));
        if (const auto world = world_place(*place)) {
            text += fmt::format("; world x {:.6f} m, y {:.6f} m, yaw {}", world->x_m, world->y_m,
                                units == Units::ros
                                    ? fmt::format("{:.5f} rad", world->yaw_rad)
                                    : fmt::format("{:.3f} deg", world->yaw_rad * kDegrees));
        }
        return text;
    }
    const std::string frame = record.has_sheets ? "on no sheet, pattern " : "";
    if (std::isfinite(record.spacing_mm)) {
        return frame + pose_text(pattern_pose(record.fix, record.spacing_mm), units);
    }
    return frame + fmt::format("x {:.4f}, y {:.4f} spacings, angle {:.3f} deg", record.fix.x_grid(),
                               record.fix.y_grid(), record.fix.theta_rad() * kDegrees);
}

}  // namespace

std::string text_line(const Record& record, Units units) {
    std::string text =
        record.fix.status == Status::ok
            ? place_text(record, units) +
                  (record.space ? "; " + space_text(*record.space, record.place, units) : "") +
                  (record.tip
                       ? "; " + tip_text({record.tip, record.is_pen_down}, record.place, units)
                       : "")
            : fmt::format("no fix ({}): {}", name(record.fix.status), reason(record));
    for (const std::string& doubt : warnings(record)) {
        if (!doubt.empty()) text += "; warning: " + doubt;
    }
    return printable(record.file + ": " + text) + '\n';
}

}  // namespace dotpose::cli
