#include "sheet_messages.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "common.hpp"
#include "dotpose/files/degrees.hpp"
#include "sheet_changes.hpp"

namespace dotpose::cli {
namespace {

using nlohmann::json;

/// Maximum number of sheets in a message.
constexpr std::size_t kMaxSheets = 2000;

json json_of(const std::optional<PagePose>& pose) {
    if (!pose) return nullptr;
    return {{"x_mm", pose->x_mm}, {"y_mm", pose->y_mm}, {"yaw_deg", pose->yaw_deg}};
}

json json_of(const std::optional<SheetPrint>& print) {
    if (!print) return nullptr;
    return {{"title", print->title},
            {"pages", print->pages},
            {"dpi", print->dpi},
            {"command", print->command},
            {"document", print->document}};
}

json json_of(const SheetEntry& entry, std::int64_t revision) {
    const Sheet& sheet = entry.sheet;
    return {{"name", entry.name},
            {"revision", revision},
            {"page", entry.page},
            {"width_mm", sheet.width_mm},
            {"height_mm", sheet.height_mm},
            {"columns", sheet.columns},
            {"rows", sheet.rows},
            {"code", code_name(sheet.pattern.code)},
            {"spacing_mm", sheet.pattern.spacing_mm},
            {"origin", {sheet.origin.x, sheet.origin.y}},
            {"first_x_mm", sheet.origin_x_mm},
            {"first_y_mm", sheet.origin_y_mm},
            {"scale_x", entry.print_scale_x},
            {"scale_y", entry.print_scale_y},
            {"is_reserved", entry.is_reserved},
            {"world", json_of(page_pose(entry))},
            {"print", json_of(entry.print)}};
}

json json_of(const StitchedSheet& sheet, const SheetEntry& entry) {
    const bool is_known =
        is_scale_known(sheet.sigma_scale_x) && is_scale_known(sheet.sigma_scale_y);
    return {{"name", sheet.name},
            {"is_fixed", sheet.is_fixed},
            {"sigma_mm", sheet.sigma_mm},
            {"sigma_deg", sheet.sigma_rad * kDegrees},
            {"scale_x", entry.print_scale_x},
            {"scale_y", entry.print_scale_y},
            {"is_scale_known", is_known},
            {"world", json_of(page_pose(entry))}};
}

}  // namespace

json sheets_message(const SheetEdits& edits, bool may_edit) {
    json sheets = json::array();
    for (const SheetEntry& entry : edits.sheets()) {
        if (sheets.size() >= kMaxSheets) break;
        sheets.push_back(json_of(entry, edits.revision(entry.name)));
    }
    return {{"may_edit", may_edit},
            {"problem", edits.problem()},
            {"undo", edits.undo_text()},
            {"redo", edits.redo_text()},
            {"not_shown", edits.sheets().size() - sheets.size()},
            {"sheets", std::move(sheets)}};
}

json answers_message(const std::deque<SheetAnswer>& answers) {
    json list = json::array();
    for (const SheetAnswer& answer : answers) {
        list.push_back({{"id", answer.id},
                        {"is_ok", answer.is_ok},
                        {"message", answer.message},
                        {"name", answer.name},
                        {"url", answer.url}});
    }
    return {{"answers", std::move(list)}};
}

json stitch_message(const StitchJob::Progress* progress) {
    if (progress == nullptr) return {{"is_on", false}};
    json pairs = json::array();
    json sheets = json::array();
    json unconnected = json::array();
    if (const auto& result = progress->result) {
        for (const Seam& seam : result->seams) {
            pairs.push_back({{"first", seam.first},
                             {"second", seam.second},
                             {"frames", seam.frames},
                             {"residual_mm", seam.residual_mm},
                             {"residual_deg", seam.residual_rad * kDegrees}});
        }
        for (const StitchedSheet& sheet : result->stitched) {
            const auto entry = std::ranges::find(result->sheets, sheet.name, &SheetEntry::name);
            sheets.push_back(json_of(sheet, *entry));
        }
        unconnected = result->unconnected;
    }
    return {{"is_on", true},
            {"tried", progress->tried},
            {"frames", progress->used},
            {"is_complete", progress->is_complete},
            {"problem", progress->problem},
            {"pairs", std::move(pairs)},
            {"sheets", std::move(sheets)},
            {"unconnected", std::move(unconnected)}};
}

}  // namespace dotpose::cli
