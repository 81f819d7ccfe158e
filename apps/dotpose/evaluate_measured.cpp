#include "evaluate_measured.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "choices.hpp"
#include "dotpose/files/write_file.hpp"
#include "exit_codes.hpp"
#include "progress.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

/// Converts a place to world coordinates or, if `is_in_world` is false, to coordinates on its
/// sheet. Returns nullopt if `place` is nullopt, or if world coordinates are requested but the
/// sheet has no world pose.
std::optional<FoundPlace> found_in(bool is_in_world, const std::optional<SheetPlace>& place) {
    if (!place) return std::nullopt;
    const std::string& sheet = place->entry->name;
    if (!is_in_world) return FoundPlace{sheet, place->x_mm, place->y_mm, place->theta_rad};
    const auto world = world_place(*place);
    if (!world) return std::nullopt;
    return FoundPlace{sheet, 1000 * world->x_m, 1000 * world->y_m, world->yaw_rad};
}

/// Returns true if the true places are in world coordinates, and false if they are in sheet
/// coordinates. Throws Error if
/// - a place is given only in the pattern frame,
/// - the sheet file does not contain the sheet of a place,
/// - a place on a sheet does not name its sheet, and the sheet file contains several sheets,
/// - the places must be aligned, but are on several sheets, or
/// - the places are in world coordinates, but no sheet has a world pose.
bool require_one_frame(const std::vector<TruthRow>& rows, const std::vector<SheetEntry>& sheets,
                       bool is_aligned) {
    bool is_in_world = false;
    std::string sheet;
    for (const TruthRow& row : rows) {
        if (!row.place) {
            if (!row.is_in_pattern) continue;
            throw Error(
                "with --sheets, poses need columns x_sheet_mm and y_sheet_mm, or x_m and y_m; "
                "those "
                "of 'dotpose simulate' are in the pattern: evaluate them without --sheets");
        }
        is_in_world = row.place->is_in_world;
        const std::string& name = row.place->sheet;
        if (!name.empty() && std::ranges::find(sheets, name, &SheetEntry::name) == sheets.end()) {
            throw Error(fmt::format("{}: the sheet file has no sheet '{}'", row.file, name));
        }
        if (name.empty() && !is_in_world && sheets.size() > 1) {
            throw Error("the sheet file has several sheets: the poses need a column 'sheet'");
        }
        if (sheet.empty()) sheet = name;
        if (is_aligned && !is_in_world && name != sheet) {
            throw Error(fmt::format(
                "places on several sheets ('{}', '{}') have no common frame to align: give places "
                "in the world (x_m, y_m), or --align none",
                sheet, name));
        }
    }
    const auto is_placed = [](const SheetEntry& entry) { return entry.world.has_value(); };
    if (is_in_world && std::ranges::none_of(sheets, is_placed)) {
        throw Error(
            "the poses are in the world, and no sheet of the file is: 'dotpose sheets place' "
            "first");
    }
    return is_in_world;
}

nlohmann::ordered_json json_of(const Spread& spread) {
    return {{"mean", spread.bias}, {"standard_deviation", spread.sigma}};
}

nlohmann::ordered_json json_of(const Measurement& measurement) {
    nlohmann::ordered_json json = {{"frames", measurement.frames.size()},
                                   {"located", measurement.located},
                                   {"wrong", measurement.wrong},
                                   {"frame", measurement.is_in_world ? "world" : "sheet"}};
    if (const auto& by = measurement.alignment) {
        json["alignment"] = {{"middle_mm", {by->middle_x_mm, by->middle_y_mm}},
                             {"shift_mm", {by->shift_x_mm, by->shift_y_mm}},
                             {"turn_rad", by->turn_rad},
                             {"scale", by->scale},
                             {"angle_offset_rad", by->angle_offset_rad}};
    }
    json["position_um"] = quantiles_json(measurement.position_um);
    json["x_um"] = json_of(measurement.x_um);
    json["y_um"] = json_of(measurement.y_um);
    json["angle_deg"] = quantiles_json(measurement.angle_deg);
    return json;
}

std::string report_of(const Measurement& measurement, bool as_json) {
    if (as_json) return json_of(measurement).dump(2) + '\n';
    std::string text;
    for (const auto& [what, value] : described(measurement))
        text += fmt::format("{:<44}{}\n", what, value);
    return text;
}

}  // namespace

nlohmann::ordered_json quantiles_json(const Quantiles& quantiles) {
    return {{"median", quantiles.median}, {"p95", quantiles.p95}, {"max", quantiles.max}};
}

void MeasuredArguments::add_to(Command& command) {
    add_sheets_option(command, sheets,
                      "Sheet file: the poses are places on its sheets (x_sheet_mm, y_sheet_mm, "
                      "theta_sheet_deg, sheet) or in the world (x_m, y_m, yaw_rad)");
    command
        .add_option_function<std::string>(
            "--align",
            [this](const std::string& name) {
                is_aligned = name == "similarity";
                alignment_given = true;
            },
            "With --sheets: remove shift, turn and scale between found and true places "
            "(similarity; they are reported), or none")
        ->type_name("NAME")
        ->default_str("similarity")
        ->check(one_of({"similarity", "none"}));
    command
        .add_option("--residuals", residuals,
                    "With --sheets: CSV file with the error of each frame")
        ->type_name("FILE");
    command
        .add_option("--draw", draw,
                    "With --sheets: folder for the paper's figures of these frames, which is "
                    "created if missing")
        ->type_name("DIR");
}

void MeasuredArguments::add_files(RunFiles& files) const {
    files.reads("--sheets", sheets);
    files.writes("--residuals", residuals, Content::csv);
    if (!std::filesystem::exists(system::path_of(draw))) files.writes("--draw", draw, Content::svg);
}

void MeasuredArguments::require_sheets() const {
    if (!sheets.empty()) return;
    const char* option = alignment_given      ? "--align"
                         : !residuals.empty() ? "--residuals"
                         : !draw.empty()      ? "--draw"
                                              : nullptr;
    if (option != nullptr) throw BadArgument(fmt::format("{} needs --sheets", option));
}

int evaluate_measured(const MeasuredArguments& arguments, const FollowerOptions& options,
                      const KnownFrames& known, const ReportArguments& report) {
    const bool is_in_world = require_one_frame(known.rows, options.sheets, arguments.is_aligned);
    Follower follower(options);
    ProgressLine line("evaluating the frames");
    std::vector<MeasuredFrame> frames;
    int exit_code = 0;
    for (std::size_t i = 0; i < known.rows.size() && !interrupted(); ++i) {
        line.update(static_cast<std::int64_t>(i), static_cast<std::int64_t>(known.rows.size()));
        const KnownFrame frame = known.frame_at(static_cast<int>(i));
        if (i >= known.readable_frames()) break;
        if (!frame.problem.empty()) {
            notify(frame.problem);
            exit_code = kExitFailed;
            continue;
        }
        const Located located = follower.locate(frame.image);
        frames.push_back({known.rows[i].file, known.rows[i].place, located.fix.status,
                          found_in(is_in_world, located.place), located.spacing_mm});
    }
    if (interrupted()) {
        notify(fmt::format("interrupted; the report covers the first {} of {} frames",
                           frames.size(), known.rows.size()));
        exit_code = kExitFailed;
    }
    const auto alignment = arguments.is_aligned ? std::optional(align(frames)) : std::nullopt;
    const Measurement measurement = compare(std::move(frames), alignment);
    write_report(report, report_of(measurement, report.as_json));
    if (!arguments.residuals.empty()) {
        std::ostringstream table;
        write_errors_csv(table, measurement);
        write_file(system::path_of(arguments.residuals), table.view());
    }
    if (!arguments.draw.empty()) write_measurement(system::path_of(arguments.draw), measurement);
    known.finish();
    return exit_code;
}

}  // namespace dotpose::cli
