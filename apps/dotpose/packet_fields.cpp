#include "packet_fields.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "common.hpp"

namespace dotpose::cli {
namespace {

/// Returns the pose in a packet in the given units and axes, or none if the packet has no fix.
std::optional<PlanePose> pose_of(const PosePacket& packet, double spacing_mm, Units units) {
    if (packet.status != Status::ok) return std::nullopt;
    const PlanePose pose{
        packet.x_grid() * spacing_mm, packet.y_grid() * spacing_mm, packet.theta_rad(), {}};
    return units == Units::ros ? with_other_y(pose) : pose;
}

/// Returns the field for the standard deviation of the position. The packet contains the larger of
/// the standard deviations along x and y.
Field deviation_field(const PosePacket& packet, double spacing_mm, Units units) {
    const double sigma_mm = packet.deviation_q12 * spacing_mm / 4096;
    // 255 means that the standard deviation is unknown, or too large for the packet.
    const bool is_known = packet.status == Status::ok && packet.deviation_q12 < 255;
    if (units == Units::ros) return {"sigma_m", is_known ? metres(sigma_mm) : ""};
    return {"sigma_mm", is_known ? decimal(sigma_mm, 6) : ""};
}

}  // namespace

std::vector<Field> fields(const PosePacket& packet, double spacing_mm, Units units) {
    const bool ok = packet.status == Status::ok;
    const auto if_ok = [ok](std::string text) { return ok ? std::move(text) : std::string(); };
    const auto number = [](unsigned value) { return fmt::format("{}", value); };
    std::vector<Field> all = {
        {"schema", kSchemaVersion},
        {"sequence", number(packet.sequence)},
        {"time_us", number(packet.time_us)},
        {"status", name(packet.status), true},
        {"message", ok ? "" : message(packet.status), true},
        {"code", code_name(packet.code), true},
    };
    const std::vector<Field> evidence = {
        {"x_grid", if_ok(decimal(packet.x_grid(), 6))},
        {"y_grid", if_ok(decimal(packet.y_grid(), 6))},
        {"section_u", if_ok(number(packet.section.u)), false, "section"},
        {"section_v", if_ok(number(packet.section.v)), false, "section"},
        {"p_wrong", if_ok(p_wrong_text(std::ldexp(1.0, -packet.certainty)))},
        deviation_field(packet, spacing_mm, units),
    };
    append(all, pose_fields(pattern_names(units), units, pose_of(packet, spacing_mm, units)));
    append(all, evidence);
    return all;
}

}  // namespace dotpose::cli
