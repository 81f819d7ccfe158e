#include "locate_record.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/core.h>

#include "dotpose/files/code_names.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/image_file.hpp"
#include "dotpose/tools/mounted_pose.hpp"
#include "space_fields.hpp"
#include "tip_fields.hpp"

namespace dotpose::cli {
namespace {

/// Columns for the pose in the pattern frame. `Columns::brief` omits them if a sheet file is given.
constexpr std::array<std::string_view, 6> kPatternPose = {
    "x_mm", "y_mm", "theta_deg", "x_pattern_m", "y_pattern_m", "yaw_pattern_rad"};
constexpr std::array<std::string_view, 18> kBriefColumns = {
    "file",    "status",          "message",    "sigma_x_mm", "sigma_y_mm",    "p_wrong",
    "warning", "sheet",           "x_sheet_mm", "y_sheet_mm", "x_m",           "y_m",
    "yaw_rad", "theta_sheet_deg", "x_sheet_m",  "y_sheet_m",  "yaw_sheet_rad", "sigma_theta_deg"};

double sigma(const Fix& fix, std::size_t axis) {
    return std::sqrt(static_cast<double>(fix.covariance[axis][axis]));
}

/// Converts a pose with y down, as on the paper, to the axis directions of `units`.
std::optional<PlanePose> in_frame_of(Units units, const std::optional<PlanePose>& pose) {
    return pose && units == Units::ros ? std::optional(with_other_y(*pose)) : pose;
}

/// Returns the reason why a position is rejected as uncertain, with the relevant numbers.
std::string uncertainty_reason(const Record& record) {
    const Fix& fix = record.fix;
    if (fix.p_wrong_log2 <= record.max_p_wrong_log2) {
        return fmt::format(
            "{} of the bits read contradict it, and the dots are too far from their predicted "
            "places; causes are bent paper or two patterns",
            fix.bit_errors);
    }
    const std::string odds =
        fix.p_wrong_log2 >= 0 ? "other positions are as likely"
                              : fmt::format("{} instead of at most {}", p_wrong_text(fix.p_wrong()),
                                            p_wrong_text(std::ldexp(1.0, record.max_p_wrong_log2)));
    // The total number of bits is not reported, because it would seem inconsistent with the number
    // of dots: cells without a detected dot are also read, so there are not exactly two bits per
    // dot.
    if (fix.bit_errors > 0) {
        return fmt::format("{}; {} of the bits read contradict it", odds, fix.bit_errors);
    }
    if (!record.advice.empty()) return fmt::format("{}; no bit contradicts it", odds);
    return fmt::format(
        "{}; no bit contradicts it, but too few of {} dots could be read with certainty: show more "
        "of the sheet, larger, sharper or in better light",
        odds, fix.dots_seen);
}

double mm(std::uint32_t cell, std::uint16_t fraction_q16, double spacing_mm) {
    return (cell + fraction_q16 / 65536.0) * spacing_mm;
}

std::string in_one_line(const std::array<std::string, kWarnings>& warnings) {
    std::string line;
    for (const std::string& warning : warnings) {
        if (!line.empty() && !warning.empty()) line += "; ";
        line += warning;
    }
    return line;
}

/// Returns the fields for the code, including the positions in both codes if two codes are
/// possible.
std::vector<Field> code_fields(const Record& record, Units units) {
    const CodeReading& reading = record.reading;
    const Fix& fix = reading.fix;
    const bool is_ok = fix.status == Status::ok;
    const bool is_ambiguous = fix.status == Status::ambiguous_code;
    const bool has_other = reading.has_other && (is_ok || is_ambiguous || record.code_is_given);
    const auto if_other = [has_other](std::string text) {
        return has_other ? std::move(text) : std::string();
    };
    const auto place = [&](bool is_known, Cell cell) {
        const double x_mm = mm(cell.x, fix.fraction_x_q16, record.spacing_mm);
        const double y_mm = mm(cell.y, fix.fraction_y_q16, record.spacing_mm);
        if (!is_known) return std::array<std::string, 2>{};
        if (units == Units::ros) return std::array{metres(x_mm), metres(-y_mm)};
        return std::array{decimal(x_mm, 6), decimal(y_mm, 6)};
    };
    const auto [x, y] = place(is_ambiguous, fix.cell);
    const auto [other_x, other_y] = place(has_other, reading.other_cell);
    const std::string unit = units == Units::ros ? "_m" : "_mm";
    const bool is_judged = is_ok && !record.code_is_given;
    return {
        {"code", is_ok || is_ambiguous ? name(reading.code) : "", true},
        {"code_p_wrong",
         is_judged ? fmt::format("{:.3g}", reading.evidence.p_wrong(reading.code)) : ""},
        {"code_x" + unit, x},
        {"code_y" + unit, y},
        {"other_code", if_other(name(reading.other_code)), true},
        {"other_x" + unit, other_x},
        {"other_y" + unit, other_y},
        {"warning", in_one_line(warnings(record)), true},
    };
}

/// Returns `text` if the fix is ok and has a covariance, and an empty string otherwise.
std::string if_judged(const Fix& fix, std::string text) {
    return fix.status == Status::ok && fix.has_covariance() ? std::move(text) : std::string();
}

template <typename Value>
Field evidence(bool is_known, const char* key, Value value) {
    constexpr bool kIsName = std::is_enum_v<Value>;
    std::string text;
    if constexpr (kIsName)
        text = name(value);
    else if constexpr (std::is_floating_point_v<Value>)
        text = decimal(static_cast<double>(value), 4);
    else
        text = fmt::format("{}", value);
    return {key, is_known ? text : "", kIsName};
}

/// Returns the fields for the position in the code and for the evidence that supports it.
std::vector<Field> evidence_fields(const Fix& fix) {
    const bool ok = fix.status == Status::ok;
    const auto if_ok = [ok](std::string text) { return ok ? std::move(text) : std::string(); };
    return {
        {"x_grid", if_ok(decimal(fix.x_grid(), 6))},
        {"y_grid", if_ok(decimal(fix.y_grid(), 6))},
        {"section_u", if_ok(fmt::format("{}", fix.section.u)), false, "section"},
        {"section_v", if_ok(fmt::format("{}", fix.section.v)), false, "section"},
#define FIX_EVIDENCE(type, name, is_known, doc) evidence(is_known, #name, fix.name),
#include "dotpose/fix_fields.def"
        {"p_wrong", if_ok(p_wrong_text(fix.p_wrong()))},
    };
}

/// Returns the fields for the standard deviations, in mm and degrees.
std::vector<Field> deviation_fields(const Record& record) {
    const Fix& fix = record.fix;
    const auto text = [&fix](double value) { return if_judged(fix, decimal(value, 6)); };
    return {
        {"sigma_x_mm", text(sigma(fix, 0) * record.spacing_mm)},
        {"sigma_y_mm", text(sigma(fix, 1) * record.spacing_mm)},
        {"sigma_theta_deg", text(sigma(fix, 2) * 180 / std::numbers::pi)},
    };
}

/// Returns the fields for the camera's velocity and turn rate during the readout of a rolling
/// shutter.
std::vector<Field> velocity_fields(const Record& record, Units units) {
    const auto text = [&](bool is_known, double per_s) {
        const double length = units == Units::ros ? 1e-3 : 1;
        return is_known ? decimal(per_s * length * record.spacing_mm, units == Units::ros ? 6 : 3)
                        : std::string();
    };
    const bool is_known = record.velocity.has_value();
    const ReadoutVelocity v = record.velocity.value_or(ReadoutVelocity{});
    const auto degrees = [&](double rad_s) {
        return is_known ? decimal(rad_s * 180 / std::numbers::pi, 3) : std::string();
    };
    if (units == Units::ros) {
        return {{"velocity_x_pattern_m_s", text(is_known, v.x_per_s)},
                {"velocity_y_pattern_m_s", text(is_known, -v.y_per_s)},
                {"yaw_rate_pattern_rad_s", is_known ? decimal(-v.turn_rad_s, 6) : std::string()}};
    }
    return {{"velocity_x_mm_s", text(is_known, v.x_per_s)},
            {"velocity_y_mm_s", text(is_known, v.y_per_s)},
            {"sigma_velocity_x_mm_s", text(is_known, std::sqrt(v.covariance[0][0]))},
            {"sigma_velocity_y_mm_s", text(is_known, std::sqrt(v.covariance[1][1]))},
            {"turn_rate_deg_s", degrees(v.turn_rad_s)},
            {"sigma_turn_rate_deg_s", degrees(std::sqrt(v.covariance[2][2]))}};
}

std::vector<Field> image_fields(const Record& record) {
    const Fix& fix = record.fix;
    const bool ok = fix.status == Status::ok;
    return {
        {"spacing_px", ok ? decimal(fix.spacing_px(), 4) : ""},
        {"elapsed_us", decimal(record.elapsed_us, 1)},
    };
}

/// Returns the reason why there is no fix, without advice. Returns an empty string if there is a
/// fix.
std::string plain_reason(const Record& record) {
    const Fix& fix = record.fix;
    switch (fix.status) {
        case Status::ok:
            return {};
        case Status::image_too_small:
            if (record.width_px == 0) return "the camera gives no image";
            return fmt::format("the image is {} x {} px; at least {} x {} are needed",
                               record.width_px, record.height_px, record.min_side_px(),
                               record.min_side_px());
        case Status::image_too_large:
            if (std::int64_t{record.width_px} * record.height_px > kDefaultImagePixels) {
                return fmt::format("the image is {} x {} px; at most {} million px are read",
                                   record.width_px, record.height_px,
                                   kDefaultImagePixels / 1'000'000);
            }
            return fmt::format("the image is {} x {} px; at most {} x {} can be located",
                               record.width_px, record.height_px, kMaxFrameSide_px,
                               kMaxFrameSide_px);
        case Status::too_few_dots:
            return fmt::format("found {} dots; at least {} are needed", fix.dots_seen,
                               record.min_dots);
        case Status::not_certain:
            return fmt::format("{}: {}", message(fix.status), uncertainty_reason(record));
        case Status::ambiguous_code:
            return fmt::format(
                "codes {} and {} explain the dots about equally well, at different places: name "
                "the --code, or show more of the sheet",
                name(record.reading.code), name(record.reading.other_code));
        default:
            return message(fix.status);
    }
}

std::string code_warning(const Record& record) {
    const CodeReading& reading = record.reading;
    if (!record.code_is_given || !reading.has_other) return {};
    const std::string place =
        reading.fix.status == Status::ok
            ? (reading.other_cell == reading.fix.cell ? "at this place" : "at another place")
            : "where this code gives no certain position";
    return fmt::format(
        "code {} explains the dots {} without a contradiction; is the sheet of code "
        "{}?",
        name(reading.other_code), place, name(reading.other_code));
}

std::string sheet_warning(const Record& record) {
    if (!record.has_sheets || record.fix.status != Status::ok || record.place) return {};
    return "this place is on no sheet of the sheet file: is the page of another file?";
}

std::string spacing_warning(const Record& record) {
    const double camera_mm = record.camera_spacing_mm;
    if (!contradicts(camera_mm, record.spacing_mm)) return {};
    return fmt::format(
        "the camera file gives a spacing of {:.3f} mm, but lengths are computed with {:g} mm: "
        "correct the spacing ({}), or calibrate the camera again",
        camera_mm, record.spacing_mm, record.has_sheets ? "of the sheet file" : "--spacing");
}

std::string space_warning(const Record& record) {
    if (!record.space || !record.space->is_ambiguous()) return {};
    return fmt::format(
        "the dots do not exclude a second pose of the camera in space (odds {}): take a larger "
        "part of the sheet into view, or move nearer",
        p_wrong_text(std::exp2(record.space->second->odds_log2)));
}

std::string map_warning(const Record& record) {
    if (record.map_use != MapUse::contradicted) return {};
    return "the dots contradict the print map, which is not used here: the print was moved, was "
           "bent "
           "or is another print; make a new map with calibrate --print-map";
}

}  // namespace

Record empty_record(const Follower& follower) {
    Record record;
    record.has_sheets = !follower.sheets().empty();
    record.has_space = follower.fits_space_pose();
    record.has_tip = follower.finds_tip();
    return record;
}

Record record_of(const Located& located, const Follower& follower) {
    Record record = empty_record(follower);
    record.fix = located.fix;
    record.reading = located.reading;
    record.code_is_given = located.code_is_given;
    record.spacing_mm = located.spacing_mm;
    record.camera_spacing_mm = located.camera_spacing_mm;
    record.place = located.place;
    record.velocity = located.velocity;
    record.space = located.space;
    record.tip = located.tip;
    record.is_pen_down = located.is_pen_down;
    record.map_use = located.map_use;
    record.width_px = follower.image().width_px;
    record.height_px = follower.image().height_px;
    record.min_dots = follower.used_options().lattice.min_dots;
    if (record.has_sheets) record.min_dots = std::min(record.min_dots, kMinKnownDots);
    record.max_p_wrong_log2 = follower.used_options().integrity.max_p_wrong_log2;
    return record;
}

std::array<std::string, kWarnings> warnings(const Record& record) {
    return {code_warning(record), sheet_warning(record), spacing_warning(record),
            space_warning(record), map_warning(record)};
}

std::string reason(const Record& record) {
    const std::string plain = plain_reason(record);
    return plain.empty() || record.advice.empty() ? plain : plain + "; " + record.advice;
}

std::vector<Field> sheet_fields(const Record& record, Units units) {
    const std::optional<SheetPlace>& place = record.place;
    std::optional<PlanePose> pose;
    if (place) pose = PlanePose{place->x_mm, place->y_mm, place->theta_rad, place->covariance};
    pose = in_frame_of(units, pose);
    const PoseNames names = sheet_names(units);
    std::vector<Field> fields = {{.name = "sheet",
                                  .text = place ? place->entry->name : std::string(),
                                  .is_string = true,
                                  .is_null_if_empty = record.fix.status == Status::ok}};
    append(fields, pose_fields(names, units, pose));
    append(fields, covariance_fields(names, units, pose));
    append(fields, world_fields(place ? world_place(*place) : std::nullopt));
    return fields;
}

std::vector<Field> fields(const Record& record, Units units) {
    const PoseNames names = pattern_names(units);
    std::optional<PlanePose> pose;
    if (record.fix.status == Status::ok) {
        pose = in_frame_of(units, pattern_pose(record.fix, record.spacing_mm));
    }
    std::vector<Field> all = {
        {"schema", kSchemaVersion},
        {"file", record.file, true},
        {"status", name(record.fix.status), true},
        {"message", reason(record), true},
    };
    append(all, pose_fields(names, units, pose));
    append(all, evidence_fields(record.fix));
    if (units == Units::mm) append(all, deviation_fields(record));
    append(all, covariance_fields(names, units, pose));
    append(all, velocity_fields(record, units));
    append(all, image_fields(record));
    append(all, code_fields(record, units));
    if (record.has_sheets) append(all, sheet_fields(record, units));
    if (record.has_space)
        append(all, space_fields(record.space, record.place, record.has_sheets, units));
    if (record.has_tip)
        append(all, tip_fields({record.tip, record.is_pen_down}, record.place, record.has_sheets,
                               units));
    return all;
}

std::vector<Field> columns_of(std::vector<Field> fields, Columns columns) {
    if (columns == Columns::all) return fields;
    const auto has_sheet = std::ranges::find(fields, "sheet", &Field::name) != fields.end();
    const auto is_among = [](const auto& names, const std::string& name) {
        return std::ranges::find(names, name) != std::end(names);
    };
    std::erase_if(fields, [&](const Field& field) {
        const bool is_pattern = is_among(kPatternPose, field.name);
        if (is_pattern) return has_sheet;
        return !is_among(kBriefColumns, field.name) && !is_brief_space_field(field.name) &&
               !is_brief_tip_field(field.name);
    });
    return fields;
}

std::string csv_header(const Follower& follower, Units units, Columns columns) {
    return csv_header(columns_of(fields(empty_record(follower), units), columns));
}

}  // namespace dotpose::cli
