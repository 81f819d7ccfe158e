#include "tip_fields.hpp"

#include <array>

#include <fmt/core.h>

namespace dotpose::cli {
namespace {

/// Formats a length in mm, or in metres for `Units::ros`.
std::string length(double mm, Units units) {
    return units == Units::ros ? metres(mm) : decimal(mm, 6);
}

TipPose tip_on(const TipPose& tip, const std::optional<SheetPlace>& place) {
    return place ? on_sheet(tip, *place->entry) : tip;
}

/// Returns the world coordinates x and y of the tip as text, in metres. Returns empty strings if
/// the world pose of the page is unknown.
std::array<std::string, 2> world_texts(const TipPose& tip, const std::optional<SheetPlace>& place) {
    if (!place || !place->entry->world) return {};
    const TipPose on_page = tip_on(tip, place);
    const CameraInWorld world =
        in_world({on_page.x_mm, on_page.y_mm, 0, {}}, {}, *place->entry->world);
    return {decimal(world.x_m, 9), decimal(world.y_m, 9)};
}

}  // namespace

std::vector<Field> tip_fields(const TipRecord& record, const std::optional<SheetPlace>& place,
                              bool has_sheets, Units units) {
    const bool is_ros = units == Units::ros;
    const double up = is_ros ? -1 : 1;
    const bool is_known = record.tip.has_value();
    const TipPose tip = record.tip.value_or(TipPose{});
    const auto text = [&](bool has, double mm) { return has ? length(mm, units) : std::string(); };
    const std::string pattern = is_ros ? "_pattern_m" : "_mm";
    const std::string unit = is_ros ? "_m" : "_mm";
    std::vector<Field> fields = {
        {"tip_x" + pattern, text(is_known, tip.x_mm)},
        {"tip_y" + pattern, text(is_known, up * tip.y_mm)},
        {"tip_height" + unit, text(is_known, tip.height_mm)},
        {"sigma_tip_x" + unit, text(is_known, tip.sigma_mm(0))},
        {"sigma_tip_y" + unit, text(is_known, tip.sigma_mm(1))},
        {"sigma_tip_height" + unit, text(is_known, tip.sigma_mm(2))},
        {"pen_down", !is_known        ? ""
                     : record.is_down ? "true"
                                      : "false"},
    };
    if (!has_sheets) return fields;
    const bool is_on_sheet = is_known && place;
    const TipPose on_page = tip_on(tip, place);
    const std::string sheet = is_ros ? "_sheet_m" : "_sheet_mm";
    const auto world = is_on_sheet ? world_texts(tip, place) : std::array<std::string, 2>{};
    append(fields, {{"tip_x" + sheet, text(is_on_sheet, on_page.x_mm)},
                    {"tip_y" + sheet, text(is_on_sheet, up * on_page.y_mm)},
                    {"tip_x_m", world[0]},
                    {"tip_y_m", world[1]}});
    return fields;
}

bool is_brief_tip_field(const std::string& name) {
    return name.starts_with("tip_") || name == "pen_down";
}

std::string tip_text(const TipRecord& record, const std::optional<SheetPlace>& place, Units units) {
    const bool is_ros = units == Units::ros;
    const TipPose tip = tip_on(record.tip.value(), place);
    const double per_mm = is_ros ? 1e-3 : 1;
    const auto with_sigma = [&](double mm, std::size_t axis) {
        return fmt::format("{} ± {:.2g} {}", decimal(per_mm * mm, is_ros ? 7 : 4),
                           per_mm * tip.sigma_mm(axis), is_ros ? "m" : "mm");
    };
    return fmt::format("tip x {}, y {}, height {}, pen {}", with_sigma(tip.x_mm, 0),
                       with_sigma(is_ros ? -tip.y_mm : tip.y_mm, 1), with_sigma(tip.height_mm, 2),
                       record.is_down ? "down" : "up");
}

}  // namespace dotpose::cli
