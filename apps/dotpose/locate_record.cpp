#include "locate_record.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <fmt/core.h>

#include "dotpose/files/profile_names.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/image_file.hpp"

namespace dotpose::cli {
namespace {

double sigma(const Fix& fix, std::size_t axis) {
    return std::sqrt(static_cast<double>(fix.covariance[axis][axis]));
}

/// The fields that `--sheets` adds.
std::vector<Field> sheet_fields(const std::optional<SheetPlace>& place) {
    std::vector<Field> fields = {
        {"sheet", {}, true}, {"x_sheet_mm", {}}, {"y_sheet_mm", {}},
        {"x_m", {}},         {"y_m", {}},        {"yaw_rad", {}},
    };
    if (!place) return fields;
    fields[0].text = place->entry->name;
    fields[1].text = decimal(place->x_mm, 6);
    fields[2].text = decimal(place->y_mm, 6);
    if (const auto world = world_place(*place)) {
        fields[3].text = decimal(world->x_m, 9);
        fields[4].text = decimal(world->y_m, 9);
        fields[5].text = decimal(world->yaw_rad, 8);
    }
    return fields;
}

/// Explains in words and numbers why a position is refused as not certain.
std::string doubt(const Record& record) {
    const Fix& fix = record.fix;
    if (fix.p_wrong_log2 <= record.max_p_wrong_log2) {
        return fmt::format(
            "{} bits of {} dots contradict it, and the dots lie too far from where it "
            "has them; paper that is bent, or two patterns, look so",
            fix.bit_errors, fix.dots_seen);
    }
    const std::string odds =
        fix.p_wrong_log2 >= 0 ? "others are as likely"
                              : fmt::format("{} instead of at most {}", p_wrong_text(fix.p_wrong()),
                                            p_wrong_text(std::ldexp(1.0, record.max_p_wrong_log2)));
    if (fix.bit_errors > 0) {
        return fmt::format("{}; {} bits of {} dots contradict it", odds, fix.bit_errors,
                           fix.dots_seen);
    }
    return fmt::format(
        "{}; no bit contradicts it, but of {} dots too few could be read for sure: "
        "show more of the sheet, larger, sharper or in better light",
        odds, fix.dots_seen);
}

double mm(std::uint32_t cell, std::uint16_t fraction_q16, double spacing_mm) {
    return (cell + fraction_q16 / 65536.0) * spacing_mm;
}

/// The fields of the profile and, if two profiles are possible, of the positions in both.
std::vector<Field> code_fields(const Record& record) {
    const CodeReading& reading = record.reading;
    const Fix& fix = reading.fix;
    const bool is_ok = fix.status == Status::ok;
    const bool is_ambiguous = fix.status == Status::ambiguous_code;
    const bool has_other = reading.has_other && (is_ok || is_ambiguous || record.code_is_given);
    const auto if_other = [has_other](std::string text) {
        return has_other ? std::move(text) : std::string();
    };
    const auto place = [&](bool is_known, Cell cell) {
        const double spacing_mm = record.spacing_mm;
        return std::array{
            is_known ? decimal(mm(cell.x, fix.fraction_x_q16, spacing_mm), 6) : std::string(),
            is_known ? decimal(mm(cell.y, fix.fraction_y_q16, spacing_mm), 6) : std::string()};
    };
    const auto [x_mm, y_mm] = place(is_ambiguous, fix.cell);
    const auto [other_x_mm, other_y_mm] = place(has_other, reading.other_cell);
    const bool is_judged = is_ok && !record.code_is_given;
    return {
        {"code", is_ok || is_ambiguous ? name(reading.code) : "", true},
        {"code_p_wrong",
         is_judged ? fmt::format("{:.3g}", reading.evidence.p_wrong(reading.code)) : ""},
        {"code_x_mm", x_mm},
        {"code_y_mm", y_mm},
        {"other_code", if_other(name(reading.other_code)), true},
        {"other_x_mm", other_x_mm},
        {"other_y_mm", other_y_mm},
        {"warning", warning(record), true},
    };
}

/// Explains why there is no fix, without advice; empty if there is one.
std::string plain_reason(const Record& record) {
    const Fix& fix = record.fix;
    switch (fix.status) {
        case Status::ok:
            return {};
        case Status::image_too_small:
            if (record.width_px == 0) return "the camera gives no image";
            return fmt::format("the image is {} x {} px; at least {} x {} are needed",
                               record.width_px, record.height_px, kMinFrameSide_px,
                               kMinFrameSide_px);
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
            return fmt::format("{}: {}", message(fix.status), doubt(record));
        case Status::ambiguous_code:
            return fmt::format(
                "codes {} and {} explain the dots about equally well, at different places: name "
                "the --code, or show more of the sheet",
                name(record.reading.code), name(record.reading.other_code));
        default:
            return message(fix.status);
    }
}

}  // namespace

Record record_of(const Located& located, const Follower& follower) {
    Record record;
    record.fix = located.fix;
    record.reading = located.reading;
    record.code_is_given = located.code_is_given;
    record.spacing_mm = located.spacing_mm;
    record.has_sheets = !follower.sheets().empty();
    record.place = located.place;
    record.width_px = follower.image().width_px;
    record.height_px = follower.image().height_px;
    record.min_dots = follower.used_options().lattice.min_dots;
    record.max_p_wrong_log2 = follower.used_options().integrity.max_p_wrong_log2;
    return record;
}

std::string warning(const Record& record) {
    const CodeReading& reading = record.reading;
    if (!record.code_is_given || !reading.has_other) return {};
    const std::string place =
        reading.fix.status == Status::ok
            ? (reading.other_cell == reading.fix.cell ? "at this place" : "at another place")
            : "where this one has nothing certain";
    return fmt::format(
        "code {} explains the dots {} without a contradiction; is the sheet of code "
        "{}?",
        name(reading.other_code), place, name(reading.other_code));
}

std::string reason(const Record& record) {
    const std::string plain = plain_reason(record);
    return plain.empty() || record.advice.empty() ? plain : plain + "; " + record.advice;
}

std::vector<Field> fields(const Record& record) {
    const Fix& fix = record.fix;
    const double spacing_mm = record.spacing_mm;
    const bool ok = fix.status == Status::ok;
    const auto if_ok = [ok](std::string text) { return ok ? std::move(text) : std::string(); };
    const auto if_judged = [&](double value, int decimals) {
        return ok && fix.has_covariance() ? decimal(value, decimals) : std::string();
    };
    std::vector<Field> all = {
        {"file", record.file, true},
        {"status", name(fix.status), true},
        {"message", reason(record), true},
        {"x_mm", if_ok(decimal(fix.x_grid() * spacing_mm, 6))},
        {"y_mm", if_ok(decimal(fix.y_grid() * spacing_mm, 6))},
        {"theta_deg", if_ok(degrees(fix.theta_rad()))},
        {"x_grid", if_ok(decimal(fix.x_grid(), 6))},
        {"y_grid", if_ok(decimal(fix.y_grid(), 6))},
        {"section_u", if_ok(fmt::format("{}", fix.section.u))},
        {"section_v", if_ok(fmt::format("{}", fix.section.v))},
        {"dots_seen", fmt::format("{}", fix.dots_seen)},
        {"dots_used", if_ok(fmt::format("{}", fix.dots_used))},
        {"attempt", if_ok(name(fix.attempt)), true},
        {"surface", fix.has_covariance() ? if_ok(name(fix.surface)) : std::string(), true},
        {"bit_errors", if_ok(fmt::format("{}", fix.bit_errors))},
        {"p_wrong", if_ok(p_wrong_text(fix.p_wrong()))},
        {"sigma_x_mm", if_judged(sigma(fix, 0) * spacing_mm, 6)},
        {"sigma_y_mm", if_judged(sigma(fix, 1) * spacing_mm, 6)},
        {"sigma_theta_deg", if_judged(sigma(fix, 2) * 180 / std::numbers::pi, 6)},
        {"residual_px", if_judged(static_cast<double>(fix.residual_px), 4)},
        {"spacing_px", if_ok(decimal(fix.spacing_px(), 4))},
        {"elapsed_us", decimal(record.elapsed_us, 1)},
    };
    for (Field& field : code_fields(record))
        all.push_back(std::move(field));
    if (record.has_sheets) {
        for (Field& field : sheet_fields(record.place))
            all.push_back(std::move(field));
    }
    return all;
}

std::string json_line(const Record& record) {
    return json_line(fields(record));
}

std::string csv_header(bool has_sheets) {
    Record record;
    record.has_sheets = has_sheets;
    return csv_header(fields(record));
}

std::string csv_line(const Record& record) {
    return csv_line(fields(record));
}

}  // namespace dotpose::cli
