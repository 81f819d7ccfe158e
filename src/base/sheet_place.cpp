#include "dotpose/files/sheet_place.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace dotpose {
namespace {

/// Returns the signed number of cells from `first` to `cell` along one axis, in the shorter
/// direction. The code plane is cyclic, so both directions lead to the cell.
std::int32_t steps(std::uint32_t first, std::uint32_t cell) {
    constexpr std::int64_t kPositions = kPositionsPerAxis;
    std::int64_t difference = std::int64_t{cell} - first;
    if (difference > kPositions / 2) difference -= kPositions;
    if (difference < -kPositions / 2) difference += kPositions;
    return static_cast<std::int32_t>(difference);
}

/// Position relative to the first intersection of a sheet, in spacings.
struct Offset {
    double x = 0;
    double y = 0;
};

/// Returns the position of a fix relative to a sheet. Returns nullopt if the fix is not in the
/// section of the sheet.
std::optional<Offset> offset_on(const Sheet& sheet, const Fix& fix) {
    const std::int32_t dx = steps(sheet.origin.x, fix.cell.x);
    const std::int32_t dy = steps(sheet.origin.y, fix.cell.y);
    const Place first = moved(sheet.pattern.code, {fix.cell, fix.section}, -dx, -dy);
    if (first.section != sheet.pattern.section) return std::nullopt;
    return Offset{dx + fix.fraction_x_q16 / 65536.0, dy + fix.fraction_y_q16 / 65536.0};
}

/// Returns true if a position is within half a spacing of an intersection of the sheet.
bool in_region(const Sheet& sheet, Offset offset) {
    return offset.x >= -0.5 && offset.x < sheet.columns - 0.5 && offset.y >= -0.5 &&
           offset.y < sheet.rows - 0.5;
}

/// Returns the angle wrapped into (-pi, pi].
double wrapped(double angle_rad) {
    const double angle = std::remainder(angle_rad, 2 * std::numbers::pi);
    return angle <= -std::numbers::pi ? angle + 2 * std::numbers::pi : angle;
}

/// Returns the covariance of a pose after its coordinates have been multiplied by `factors`.
PoseCovariance scaled(const auto& covariance, const std::array<double, 3>& factors) {
    PoseCovariance result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            result[i][j] = static_cast<float>(factors[i] * factors[j] * double{covariance[i][j]});
    }
    return result;
}

SheetPlace place_on(const SheetEntry& entry, Offset offset, const Fix& fix) {
    const Sheet& sheet = entry.sheet;
    const double spacing_mm = sheet.pattern.spacing_mm;
    const double x_scale = entry.print_scale_x;
    const double y_scale = entry.print_scale_y;
    const double c = std::cos(fix.theta_rad()) * x_scale;
    const double s = std::sin(fix.theta_rad()) * y_scale;
    // Derivative of atan2(s, c) with respect to theta.
    const double turn = x_scale * y_scale / (c * c + s * s);
    return {&entry, sheet.origin_x_mm + offset.x * spacing_mm * x_scale,
            sheet.origin_y_mm + offset.y * spacing_mm * y_scale, wrapped(std::atan2(s, c)),
            scaled(fix.covariance, {spacing_mm * x_scale, spacing_mm * y_scale, turn})};
}

bool on_page(const SheetPlace& place) {
    const Sheet& sheet = place.entry->sheet;
    return place.x_mm >= 0 && place.x_mm <= sheet.width_mm && place.y_mm >= 0 &&
           place.y_mm <= sheet.height_mm;
}

}  // namespace

std::optional<SheetPlace> find_sheet(std::span<const SheetEntry> sheets, CodeVariant code,
                                     const Fix& fix) {
    if (fix.status != Status::ok) return std::nullopt;
    std::optional<SheetPlace> on_margin;
    for (const SheetEntry& entry : sheets) {
        if (entry.sheet.pattern.code != code) continue;
        const auto offset = offset_on(entry.sheet, fix);
        if (!offset) continue;
        const SheetPlace place = place_on(entry, *offset, fix);
        if (in_region(entry.sheet, *offset)) return place;
        if (!on_margin && on_page(place)) on_margin = place;
    }
    return on_margin;
}

std::optional<WorldPlace> world_place(const SheetPlace& place) {
    const auto& world = place.entry->world;
    if (!world) return std::nullopt;
    // On a sheet, y points down and angles are clockwise. In the world, y points up and angles are
    // counter-clockwise.
    const double right_m = place.x_mm / 1000;
    const double up_m = -place.y_mm / 1000;
    const double yaw_of_image_rad = -place.theta_rad;
    const double c = std::cos(world->yaw_rad);
    const double s = std::sin(world->yaw_rad);
    return WorldPlace{world->x_m + c * right_m - s * up_m, world->y_m + s * right_m + c * up_m,
                      wrapped(world->yaw_rad + yaw_of_image_rad),
                      scaled(world_covariance(place.covariance, world->yaw_rad), {1e-3, 1e-3, 1})};
}

PoseCovariance world_covariance(const PoseCovariance& on_sheet, double sheet_yaw_rad) {
    const auto c = static_cast<float>(std::cos(sheet_yaw_rad));
    const auto s = static_cast<float>(std::sin(sheet_yaw_rad));
    const PoseCovariance turn = {{{c, s, 0}, {s, -c, 0}, {0, 0, -1}}};
    PoseCovariance result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t k = 0; k < 3; ++k) {
                for (std::size_t l = 0; l < 3; ++l)
                    result[i][j] += turn[i][k] * on_sheet[k][l] * turn[j][l];
            }
        }
    }
    return result;
}

}  // namespace dotpose
